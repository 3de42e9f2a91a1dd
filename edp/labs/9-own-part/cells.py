# %% Commands
# The pressure along the contact: change the element or the material in the flags, and run the cell again.
result = run("hook", "-order", 2)
points = columns(result.path / "contact.csv")
order = np.argsort(points["along"])
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.plot(points["along"][order], points["pressure"][order], ".-")
axes.set_xlabel("along the contact [mm]")
axes.set_ylabel("pressure [MPa]")
print({name: result.summary[name] for name in ("pressureMax", "halfWidth", "newton", "backsolves")})
