# %% Commands
# The pressure over the distance from the axis beside Hertz: choose the mesh size, and run the cell again.
h = 0.2
result = run("sphere", "-h", h)
points, found = result.contact, result.summary
r = np.hypot(points["x"], points["y"])
radius = found["halfWidthMoment"] if "halfWidthMoment" in found else found["contacts"][0]["semiAxes"][0]
peak = 1.5 * found["force"] / (np.pi * radius**2)  # of Hertz, for this force and radius
inside = np.linspace(0, radius, 100)
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(r, points["pressure"], ".", label=f"computed, h = {h:g}")
axes.plot(inside, peak * np.sqrt(1 - (inside / radius) ** 2), label="Hertz")
axes.set_xlim(0, 2 * radius)
axes.set_xlabel("distance from the axis [length unit]")
axes.set_ylabel("pressure [force/area unit]")
axes.legend();
