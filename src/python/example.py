"""Shows where Saccade looks in the frames of a source: colour, map and fixations side by side.

python3 example.py [SOURCE [FILE.png]]: shows the first frame, or writes it as a picture.
"""

# %% Compute
import sys

import matplotlib

source = sys.argv[1] if len(sys.argv) > 1 else "synthetic:table?noise=kinect"
picture = sys.argv[2] if len(sys.argv) > 2 else None
if picture:
    matplotlib.use("Agg")  # needs no display
import matplotlib.pyplot as plt

import saccade

saliency = saccade.Saliency(fixations=5, normals=True)
frame = next(saccade.open(source))
result = saliency.compute(frame)

# %% Print
for rank, fixation in enumerate(result.fixations, 1):
    x, y, z = fixation.position_mm
    print(f"{rank}: row {fixation.row}, col {fixation.col}, {z:.0f} mm away, {fixation.pixels} pixels")

# %% Plot
figure, axes = plt.subplots(1, 3, figsize=(15, 4.5))
images = {
    "frame": frame.depth if frame.colour is None else frame.colour[..., ::-1],
    "saliency": result.map,
    "normals": (result.normals / 2 + 0.5).clip(0, 1),
}
for axis, (title, image) in zip(axes, images.items()):
    axis.imshow(image)
    axis.set_title(title)
    axis.axis("off")
    for rank, fixation in enumerate(result.fixations, 1):
        axis.plot(fixation.col, fixation.row, "o", markersize=14, markerfacecolor="none", markeredgecolor="red")
        axis.annotate(str(rank), (fixation.col, fixation.row), color="red", ha="center", va="center")
figure.tight_layout()
if picture:
    figure.savefig(picture)
else:
    plt.show()
