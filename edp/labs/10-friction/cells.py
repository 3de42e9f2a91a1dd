# %% Commands
# Pressure and friction along the contact after pressing, then dragging.
points = columns("results/labs/10-friction/press-then-drag/contact.csv")
friction = 0.3
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(points["x"], friction * points["pressure"], "--", label="bound μ p")
axes.plot(points["x"], np.abs(points["traction"]), label="friction")
axes.set_xlabel("x (length)")
axes.set_ylabel("traction (pressure)")
axes.legend();
