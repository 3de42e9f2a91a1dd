# %% Commands
# The residual over the Newton steps, and the pressure of the last: change kappa or m, and run the cell again.
kappa, m = 1000, 3
paper = run_of("edp/main.edp", "-method", "paper", "-order", 1, "-h", 0.5, "-kappa", kappa, "-m", m,
               out="results/labs/notebook/paper")
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
for model in np.unique(paper.history["adaptation"]):
    of = paper.history["adaptation"] == model
    left.semilogy(paper.history["newton"][of], paper.history["residual"][of], "o-", label=f"model {model:.0f}")
left.set_xlabel("Newton step [–]")
left.set_ylabel("residual [–]")
left.legend()
right.plot(paper.contact["x"], paper.contact["pressure"], ".-")
right.set_xlabel("x [length unit]")
right.set_ylabel("pressure [force/area unit]")
print("adaptations", paper.summary["adaptations"], "Newton steps", paper.summary["newton"], "force", paper.summary["force"])
