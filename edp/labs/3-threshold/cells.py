# %% Commands
# The threshold of each model, and the overlap.
models = columns("results/labs/3-threshold/loop/adaptations.csv")
numbers = np.unique(models["adaptation"])
figure, panels = plt.subplots(1, len(numbers), figsize=(3 * len(numbers), 3), sharey=True, layout="constrained")
for axes, number in zip(panels, numbers, strict=True):
    of = models["adaptation"] == number
    axes.plot(models["x"][of], models["threshold"][of], "--", label="threshold T")
    axes.plot(models["x"][of], models["overlap"][of], label="overlap d")
    axes.set_ylim(-0.5, 0.1)
    axes.set_title(f"model {number:.0f}")
    axes.set_xlabel("x [length unit]")
panels[0].set_ylabel("threshold T, overlap d [length unit]")
panels[0].legend();

# %% 3
# One model, then the next threshold from its greatest pressure, at every point. Stop where no wall acts.
greatest = run("one", "-maxAdaptations", 1).summary["pressureMax"]
threshold = None  # d0 + ... of the greatest pressure: your formula
print(greatest)
if threshold is not None:
    again = run("two", "-T0", threshold).summary
    print("points at the wall", again["wallPoints"], "Newton steps", again["newton"])

# %% 5
counts = {}
for h in (0.5, 0.25):
    summary = run(f"h-{h}", "-h", h).summary
    counts[h] = summary["adaptations"], summary["newton"]
counts
