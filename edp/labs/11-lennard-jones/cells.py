# %% Commands
# Force over approach of the package's path: where the force jumps, two states belong to one approach.
series = columns("results/labs/11-lennard-jones/path/path.csv")
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(series["approach"], series["force"], ".-")
axes.axhline(0, color="grey", linewidth=0.8)
axes.set_xlabel("approach [length unit]")
axes.set_ylabel("force [force unit]");
