# %% Commands
# Newton steps and back-substitutions over the stiffness of the law: change the list or the method, and run the cell again.
method, stiffness = "xnewton", [1e3, 1e6, 1e9]
results = [run("stiff", "-method", method, "-h", 0.5, "-kappa", kappa).summary for kappa in stiffness]
figure, axes = plt.subplots(figsize=(6, 3.5), layout="constrained")
axes.semilogx(stiffness, [summary["newton"] for summary in results], "o-", label="Newton steps")
axes.semilogx(stiffness, [summary["backsolves"] for summary in results], "s-", label="back-substitutions")
axes.semilogx(stiffness, [summary["factorisations"] for summary in results], "^-", label="factorisations")
axes.set_xlabel("stiffness κ of the law [stress/length³]")
axes.set_ylabel(f"count, {method} [–]")
axes.legend();
