# %% Commands
# The pressure over the approach of your law: change the stiffness of its springs, and run the cell again.
def draw(spring):
    run("series", "-spring", spring, "-history", 1, "-steps", 20)
    series = columns("results/labs/notebook/series/series.csv")
    figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
    axes.plot(series["approach"], series["pressureMax"], "o-", label=f"stiffness of the springs {spring:g}")
    axes.set_xlabel("approach u0 [length unit]")
    axes.set_ylabel("greatest pressure [force/area unit]")
    axes.legend()
    plt.show()


explore(draw, spring=[20, 1, 5, 100, 1e3, 1e6])
