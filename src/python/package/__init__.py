"""Saliency and attention points of RGB-D images by local 3D symmetry.

    import saccade

    saliency = saccade.Saliency(kernel=15, fixations=5)
    for frame in saccade.open("table.oni"):
        result = saliency.compute(frame)
        print(frame.index, [(f.id, f.row, f.col) for f in result.fixations])

Arrays of your own go in as they are: saliency.compute(depth, colour, camera=(fx, fy, cx, cy)). Bad arrays and settings
raise TypeError or ValueError, and failures while reading or computing raise saccade.Error; each says what to do.
"""

from ._saccade import Error, Fixation, Frame, Result, Saliency, Source, __version__, open

__all__ = ["Error", "Fixation", "Frame", "Result", "Saliency", "Source", "open"]

for _type in (Error, Fixation, Frame, Result, Saliency, Source):
    _type.__module__ = __name__  # what a traceback and help() print
del _type
