# %% [markdown]
# # A model made elsewhere, from Python
#
#     PYTHONPATH=build/python /usr/bin/python3 studies/model_file/notebook.py

# %%
import pathlib
import sys
import tempfile

import numpy as np

import dovetail

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import write_model  # noqa: E402

# %% [markdown]
# The rod with friction of `write_model.py`, and the amplitude of its free end at w = 2.5 rad/s.

# %%
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "rod.h5"
    write_model.write_model(path, write_model.rod(10))
    model = dovetail.Model.read(path)
print(model)
answer = dovetail.response(model, 2.5 / (2 * np.pi), harmonics=3, pseudo_penalty=1)
tip = answer.outputs["tip"]
print("harmonics", [float(np.hypot(c, s)) for c, s in zip(tip["cosine"][0], tip["sine"][0])])

# %% [markdown]
# The resonance over the coefficient of friction: the arrays are the model's own.

# %%
frequencies = np.linspace(0.16, 0.64, 49)
for friction in (0.1, 0.25, 0.5, 1.0):
    model.contact.friction[:] = friction
    curve = dovetail.response(model, frequencies)
    amplitude = np.array(curve.outputs["tip"]["amplitude"], float)
    print(f"friction {friction:4}: largest amplitude {np.nanmax(amplitude):.4f} m at "
          f"{frequencies[np.nanargmax(amplitude)]:.2f} Hz")

# %% [markdown]
# Where its wear comes to rest.

# %%
model.contact.friction[:] = 0.5
worn = dovetail.wear(model, method="asymptote", frequency=0.4)
print(worn.status, worn.worn_volume_m3, worn.depth_m)
