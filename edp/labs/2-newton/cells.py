# %% Theory
# Predict before you count.
def predicted(kappa, m=3, k=6.73077, delta=2.25):
    """Steps of the first phase, of your formula."""
    return None


for kappa in (1e3, 1e6, 1e9, 1e12):
    print(f"{kappa:g}", predicted(kappa))

# %% Commands
# The points at every step are in steps.csv; in the block all points are alike.
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
for m in (2, 3, 8):
    steps = columns(f"results/labs/2-newton/m-{m}/steps.csv")
    s = np.array([steps["s"][steps["newton"] == step][0] for step in np.unique(steps["newton"])])
    axes.semilogy(np.maximum(s - s[-1], 1e-17), "o-", label=f"m = {m}")
    print(f"m = {m}: first ratio {(s[1] - s[-1]) / (s[0] - s[-1]):.4f}, 1 − 1/m = {1 - 1 / m:.4f}")
axes.set_xlabel("Newton step [–]")
axes.set_ylabel("error s − s* [length unit]")
axes.legend();

# %% 7
for flags in (["-method", "linesearch"], ["-method", "incremental", "-steps", 5]):
    print(flags, run(flags[1], *flags, "-states", 0).summary["newton"])
