# For a machine without Debian; the folder, with what is edited and computed in it, stays that of the machine:
#   docker build -t stiff-contact .
#   docker run --rm -it -v "$PWD:/contact" -v /contact/.venv stiff-contact
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates make nano
COPY . /contact
WORKDIR /contact
RUN make setup
CMD ["bash"]
