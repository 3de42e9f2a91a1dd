# %% Commands
# Force over approach, down and up again: the loop is the energy lost.
series = columns("results/labs/7-gecko/xnewton/path.csv")
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(series["approach"], series["force"], ".-")
axes.axhline(0, color="grey", linewidth=0.8)
axes.set_xlabel("approach [length unit]")
axes.set_ylabel("force [force unit]")
print("greatest tensile force", -series["force"].min())
