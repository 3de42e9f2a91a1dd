# For a machine without Debian: docker build -t stiff-contact . && docker run --rm -it -v "$PWD/results:/contact/results" stiff-contact
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates make
COPY . /contact
WORKDIR /contact
RUN make setup
CMD ["bash"]
