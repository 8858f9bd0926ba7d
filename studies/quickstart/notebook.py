# %% [markdown]
# # The quickstart from Python
#
#     PYTHONPATH=build/python /usr/bin/python3 studies/quickstart/notebook.py
#
# or cell by cell in an editor that knows `# %%`. Numbers are those of the program, to the last bit.

# %%
import pathlib
import tempfile

import numpy as np

import dovetail

HERE = pathlib.Path(__file__).resolve().parent
study = dovetail.Study(HERE / "study.toml")

# %% [markdown]
# The start design, with an error bar for every response.

# %%
start = study.evaluate()
print(f"{start.status}, feasible: {start.feasible}")
for name, value in start.responses.items():
    print(f"  {name:32} {value:12.5g} +- {start.error_estimates.get(name, float('nan')):.2g}")

# %% [markdown]
# How the wear depends on the fit of the flanks.

# %%
for mismatch in np.linspace(-5, 25, 7):
    study.set("geometry.flank_mismatch_um", mismatch)
    design = study.evaluate(no_bars=True, no_history=True)
    volume, depth = (design.responses[f"asymptotic_wear_{what}"] for what in ("volume_m3", "depth_max_m"))
    print(f"mismatch {mismatch:5.1f} um: {1e9 * volume:.3f} mm^3, {1e6 * depth:.2f} um deep, "
          f"amplitude {1e3 * design.responses['peak_amplitude_m']:.3f} mm")
study.set("geometry.flank_mismatch_um", 0)

# %% [markdown]
# The reduced model: arrays, not copies. Its glued frequencies follow from its matrices, and its response from the
# contact engine.

# %%
model = study.reduce()
inner = np.setdiff1d(np.arange(len(model)), np.r_[model.contact.normal, model.contact.tangential.ravel()])
glued = np.sqrt(np.diag(model.stiffness)[inner] / np.diag(model.mass)[inner]) / (2 * np.pi)
print(f"{model}: glued at {np.round(np.sort(glued)[:3], 1)} Hz")
resonance = start.responses["resonance_hz"]
curve = dovetail.response(model, np.linspace(0.998, 1.002, 9) * resonance)
for hz, amplitude in zip(curve.frequency_hz, curve.outputs[model.output_names[0]]["amplitude"]):
    print(f"  {hz:9.3f} Hz {1e3 * amplitude:7.3f} mm")
worn = dovetail.wear(model, method="asymptote", frequency=resonance)
print(f"worn at {worn.frequency_hz:.3f} Hz: {1e9 * worn.worn_volume_m3[0]:.3f} mm^3")

# %% [markdown]
# A short search (the whole one has 90 evaluations), with a look at each design as it comes.

# %%
study.set("optimizer.scan_evaluations", 4)
study.set("optimizer.max_evaluations", 8)
study.set("optimizer.verify", 0)


def tell(number, evaluation, best):
    print(f"  evaluation {number}: {evaluation.responses.get('asymptotic_wear_volume_m3')}, best so far: {best}")


with tempfile.TemporaryDirectory() as folder:
    result = dovetail.run(study, pathlib.Path(folder) / "run", callback=tell)
    print(result["status"])
    print(result["summary"])
