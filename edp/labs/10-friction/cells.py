# %% Commands
# Pressure and friction along the contact after pressing, then dragging.
result = read_run(Path("results/labs/10-friction/press-then-drag"))
points, friction = columns(result.path / "contact.csv"), result.summary["parameters"]["friction"]
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(points["x"], friction * points["pressure"], "--", label="bound μ p")
axes.plot(points["x"], np.abs(points["shear"]), label="friction")
axes.set_xlabel("x [length unit]")
axes.set_ylabel("traction [force/area unit]")
axes.legend();
