# %% Commands
# The estimated error of the force over the unknowns, element by element.
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
for order, sizes in {"P1": ("1", "0.5", "0.25", "0.12"), "P2": ("1", "0.5", "0.25"), "P4": ("2", "1", "0.5")}.items():
    summaries = [read_run(Path(f"results/labs/8-error/{order}-{h}")).summary for h in sizes]
    errors = [summary["estimates"]["force"]["error"] / summary["force"] for summary in summaries]
    axes.loglog([summary["ndof"] for summary in summaries], np.abs(errors), "o-", label=order)
axes.set_xlabel("unknowns [–]")
axes.set_ylabel("estimated relative error of the force [–]")
axes.legend();
