"""Saliency and attention points of RGB-D images by local 3D symmetry.

    import saccade

    saliency = saccade.Saliency(kernel=15, fixations=5)
    for frame in saccade.open("table.oni"):
        result = saliency.compute(frame)
        print(frame.index, result.fixations)

Arrays go in as they are: saliency.compute(depth, colour, camera=(fx, fy, cx, cy)). Bad arrays and settings raise
TypeError or ValueError, and what goes wrong while reading or computing raises saccade.Error; each says what to do.
"""

from ._saccade import Error, Fixation, Frame, Result, Saliency, Source, __version__, open

__all__ = ["Error", "Fixation", "Frame", "Result", "Saliency", "Source", "open"]
