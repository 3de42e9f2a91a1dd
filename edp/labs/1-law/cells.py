# %% Theory
# Predict, with the data above, before you run.
first_touch = None  # the u0 of first touch: your number
slope_at_first, slope_at_last = None, None  # of the force over u0

# %% Commands
# The force over the approach, with your prediction; the states where the law's curve and the block's line cross.
series = columns("results/labs/1-law/series/series.csv")
runs = {kappa: run(f"kappa-{kappa:g}", "-kappa", kappa) for kappa in (1, 1e3, 1e6, 1e9)}
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
left.plot(series["approach"], series["force"], "o-")
if first_touch is not None:
    left.axvline(first_touch, color="tab:red")
left.set_xlabel("approach u0 [length unit]")
left.set_ylabel("force [force/length unit]")
modulus, depth, delta = 100 * 0.7 / (1.3 * 0.4), 20, 2.5 - 0.5 + 0.25
s = np.linspace(0, delta, 200)
right.plot(s, modulus / depth * (delta - s), color="grey", label="the block")
for kappa, result in runs.items():
    right.plot(result.contact["s"].mean(), result.contact["pressure"].mean(), "o", label=f"κ = {kappa:g}")
right.set_xlabel("overlap beyond d0, s = d − d0 [length unit]")
right.set_ylabel("pressure [force/area unit]")
right.legend();

# %% 3
overlaps = [result.contact["s"].mean() for result in runs.values()]
print([round(overlaps[k] / overlaps[k + 1], 3) for k in range(3)])
