# %% [markdown]
# # The reference's sequence in a plane section, from Python
#
#     PYTHONPATH=build/python /usr/bin/python3 studies/paper_section/notebook.py
#
# The figures themselves come from `studies/paper_section/run`; here are their numbers, to go on from.

# %%
import pathlib

import numpy as np

import dovetail

study = dovetail.Study(pathlib.Path(__file__).resolve().parent / "study.toml")
model = study.reduce()

# %% [markdown]
# Response with friction, and glued: without friction's limit nothing slides.

# %%
unworn = study.evaluate(unworn=True)
resonance = unworn.responses["resonance_hz"]
frequencies = resonance * np.linspace(0.998, 1.002, 41)


def amplitudes(of):
    return np.array(dovetail.response(of, frequencies).outputs[of.output_names[0]]["amplitude"], float)


with_friction = amplitudes(model)
friction = model.contact.friction.copy()
model.contact.friction[:] = 1e3
glued = amplitudes(model)
model.contact.friction[:] = friction
print(f"peak with friction {1e3 * with_friction.max():.3f} mm, glued {1e3 * glued.max():.3f} mm: "
      f"{100 * (1 - with_friction.max() / glued.max()):.0f} % less")

# %% [markdown]
# The history of the wear at the unworn resonance, and the state in which it ends, found directly.

# %%
directly = dovetail.wear(study, method="asymptote", frequency=resonance)
history = dovetail.wear(study, method="history", frequency=resonance, increment=max(directly.depth_m) / 80)
volume = np.array(history.worn_volume_m3, float)
print(f"{len(volume)} states, {1e9 * volume[-1]:.4f} mm^3 in the end, directly {1e9 * directly.worn_volume_m3[0]:.4f}")
largest = np.array(history.wear_rates_m_per_cycle, float).max(axis=1)
cycles = np.array(history.cycles, float)  # nan: of a state added by the direct method
for at in np.linspace(0, len(volume) - 1, 6).astype(int):
    print(f"  {cycles[at]:10.3g} cycles: {1e9 * volume[at]:.4f} mm^3, "
          f"largest rate {largest[at]:.3g} m per cycle")
