# %% Commands
import json

# The measured forces with their 95 % intervals, and both laws with the parameters found.
measured = columns("edp/labs/12-identify/measured.csv")
found = json.loads(Path("results/labs/12-identify/start/identify.json").read_text())
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.errorbar(measured["approach"], measured["force"], 2 * measured["sd"], fmt="k.", capsize=3, label="measured")
for law, line in zip(found["laws"], ("-", "--"), strict=True):
    axes.plot(measured["approach"], law["modelled"], line, label=f"{law['law']}: S = {law['sumOfSquares']:.1f}")
axes.set_xlabel("approach [length unit]")
axes.set_ylabel("force [force/length unit]")
axes.legend();
