"""The module gives the bits of `saccade run`, and its texts and types are whole."""

import inspect
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy
import saccade

HOME = pathlib.Path(os.environ["SACCADE_SOURCE_DIR"])
RECORDING = str(HOME / "recordings/table.oni")


class EqualsRun(unittest.TestCase):
    def compare(self, source, options, settings, every):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            program = [os.environ["SACCADE_PROGRAM"], "run", source, "--out", folder, "--quiet", "--every", str(every)]
            subprocess.run(program + ["--frames", "2", "--dump", "maps"] + options, check=True)
            lines = [json.loads(line) for line in (out / "fixations.jsonl").read_text().splitlines()]
            maps = sorted(out.glob("*_saliency.tiff"))
            saliency = saccade.Saliency(workers=1, **settings)
            frames = list(saccade.open(source, every=every, frames=2))
            self.assertEqual([frame.index for frame in frames], [line["frame"] for line in lines])
            self.assertEqual(len(maps), 2)
            for frame, line, tiff in zip(frames, lines, maps):
                result = saliency.compute(frame)
                self.assertIn(result.map.tobytes(), tiff.read_bytes())
                self.assertGreater(len(line["fixations"]), 0)
                self.assertEqual(len(result.fixations), len(line["fixations"]))
                for ours, theirs in zip(result.fixations, line["fixations"]):
                    self.assertEqual((ours.row, ours.col), (theirs["row"], theirs["col"]))
                    self.assertEqual(ours.saliency, numpy.float32(theirs["saliency"]))
                    position = tuple(float(numpy.float32(theirs[key])) for key in ("x_mm", "y_mm", "z_mm"))
                    self.assertEqual(ours.position_mm, position)
                    self.assertEqual(ours.pixels, theirs.get("pixels", 0))

    def test_recording(self):
        self.compare(RECORDING, [], {}, every=3)

    def test_other_settings_and_small_images(self):
        self.compare(
            "synthetic:table?noise=kinect&size=160x120&frames=4",
            ["--kernel", "9", "--length-scale", "millimetre", "--selector", "wta", "--fixations", "3"],
            {"kernel": 9, "length_scale": "millimetre", "selector": "wta", "fixations": 3},
            every=1,
        )


class Sources(unittest.TestCase):
    def test_arrays_of_a_frame_equal_the_frame(self):
        frame = next(saccade.open(RECORDING))
        saliency = saccade.Saliency()
        whole = saliency.compute(frame)
        parts = saliency.compute(frame.depth, frame.colour, camera=frame.camera)
        self.assertEqual(whole.map.tobytes(), parts.map.tobytes())
        self.assertEqual(repr(whole.fixations), repr(parts.fixations))

    def test_length_and_selection(self):
        source = saccade.open("synthetic:cone?size=64x48&frames=7", start=1, every=2)
        self.assertEqual(len(source), 3)
        self.assertEqual([frame.index for frame in source], [1, 3, 5])
        self.assertEqual(source.rejected, [])

    def test_errors_say_what_to_do(self):
        with self.assertRaisesRegex(saccade.Error, "/nowhere"):
            saccade.open("/nowhere/x.oni")
        with self.assertRaisesRegex(ValueError, "did you mean kernel"):
            saccade.Saliency(kernle=3)
        with self.assertRaisesRegex(ValueError, "3..127"):
            saccade.Saliency(kernel=1)
        with self.assertRaisesRegex(ValueError, "no effect here"):
            saccade.Saliency(dump="none")

    def test_other_threads_run_while_it_computes(self):
        depth = next(saccade.open(RECORDING)).depth
        saliency = saccade.Saliency(workers=1)
        done, steps = threading.Event(), 0

        def work():
            for _ in range(5):
                saliency.compute(depth)
            done.set()

        worker = threading.Thread(target=work)
        worker.start()
        while not done.wait(0.001):
            steps += 1
        worker.join()
        self.assertGreater(steps, 5)


class Texts(unittest.TestCase):
    def test_every_class_has_help_and_types(self):
        stub = (HOME / "src/python/saccade/__init__.pyi").read_text()
        for name in saccade.__all__:
            thing = getattr(saccade, name)
            self.assertTrue(name == "Error" or inspect.getdoc(thing), name)
            self.assertRegex(stub, rf"(class|def) {name}\b")
            if not inspect.isclass(thing) or name == "Error":
                continue
            body = re.search(rf"^class {name}.*?(?=^\S|\Z)", stub, re.M | re.S).group()
            for member in vars(thing):
                if not member.startswith("_"):
                    self.assertIn(f"def {member}(", body)

    def test_example_plots(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("python3-matplotlib is not installed")
        with tempfile.TemporaryDirectory() as folder:
            picture = pathlib.Path(folder) / "look.png"
            subprocess.run([sys.executable, HOME / "src/python/example.py", RECORDING, picture], check=True,
                           stdout=subprocess.DEVNULL, env={**os.environ, "MPLCONFIGDIR": folder})
            self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()
