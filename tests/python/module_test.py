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


def floats(numbers):
    return tuple(float(numpy.float32(number)) for number in numbers)


class EqualsRun(unittest.TestCase):
    def compare(self, source, options, settings, every):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)
            program = [os.environ["SACCADE_PROGRAM"], "run", source, "--out", folder, "--quiet", "--every", str(every)]
            subprocess.run(program + ["--frames", "3", "--dump", "maps"] + options, check=True)
            lines = [json.loads(line) for line in (out / "fixations.jsonl").read_text().splitlines()]
            maps = sorted(out.glob("*_saliency.tiff"))
            saliency = saccade.Saliency(workers=1, **settings)
            frames = list(saccade.open(source, every=every, frames=3))
            self.assertEqual([frame.index for frame in frames], [line["frame"] for line in lines])
            self.assertEqual(len(maps), 3)
            for frame, line, tiff in zip(frames, lines, maps):
                result = saliency.compute(frame)
                self.assertIn(result.map.tobytes(), tiff.read_bytes())
                self.compare_sequence(result, line)
                self.assertGreater(len(line["fixations"]), 0)
                self.assertEqual(len(result.fixations), len(line["fixations"]))
                for ours, theirs in zip(result.fixations, line["fixations"]):
                    self.assertEqual((ours.row, ours.col), (theirs["row"], theirs["col"]))
                    self.assertEqual(ours.saliency, numpy.float32(theirs["saliency"]))
                    self.assertEqual(ours.position_mm, floats(theirs[key] for key in ("x_mm", "y_mm", "z_mm")))
                    self.assertEqual(ours.pixels, theirs.get("pixels", 0))
                    self.assertEqual(ours.id, theirs.get("id"))
                    self.assertEqual(ours.age_frames, theirs.get("age_frames", 0))
                    if ours.id is not None:
                        self.assertEqual(ours.world_mm, floats(theirs["world_mm"]))
                    if "confidence" in theirs:
                        self.assertEqual((ours.confidence,), floats([theirs["confidence"]]))
                    else:
                        self.assertIsNone(ours.confidence)

    def compare_sequence(self, result, line):
        self.assertEqual(result.gaze, line.get("gaze"))
        self.assertEqual(result.cut, line.get("cut", False))
        if "camera_to_world" in line:
            numpy.testing.assert_allclose(result.camera_to_world.ravel(), line["camera_to_world"], rtol=1e-8)
        else:
            self.assertIsNone(result.camera_to_world)

    def test_recording_with_objects_over_time(self):
        self.compare(RECORDING, [], {}, every=3)

    def test_frames_one_by_one(self):
        self.compare(RECORDING, ["--tracking", "off"], {"tracking": "off"}, every=5)

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
        saliency = saccade.Saliency(tracking="off")
        whole = saliency.compute(frame)
        parts = saliency.compute(frame.depth, frame.colour, camera=frame.camera)
        self.assertEqual(whole.map.tobytes(), parts.map.tobytes())
        self.assertEqual(repr(whole.fixations), repr(parts.fixations))

    def test_arrays_can_be_a_sequence(self):
        frames = list(saccade.open(RECORDING, frames=4))
        ours, theirs = saccade.Saliency(tracking="on"), saccade.Saliency()
        for frame in frames:
            parts = ours.compute(frame.depth, frame.colour, camera=frame.camera, timestamp_us=frame.timestamp_us)
            whole = theirs.compute(frame)
            self.assertEqual([f.id for f in parts.fixations], [f.id for f in whole.fixations])
            self.assertTrue((parts.camera_to_world == whole.camera_to_world).all())
        self.assertGreater(parts.fixations[0].age_frames, 1)
        ours.reset()
        again = ours.compute(frames[0].depth, frames[0].colour, camera=frames[0].camera)
        self.assertEqual((again.fixations[0].id, again.fixations[0].age_frames), (1, 1))

    def test_closed(self):
        with saccade.open(pathlib.Path(RECORDING)) as source:
            self.assertEqual(next(source).index, 0)
        with self.assertRaisesRegex(ValueError, "the source is closed"):
            next(source)
        self.assertEqual(source.kind, "oni")

    def test_settings_of_the_source(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["SACCADE_PROGRAM"], "export", "synthetic:cone?size=64x48&frames=1",
                            "--out", folder, "--quiet"], check=True)
            plain, scaled = next(saccade.open(folder)), next(saccade.open(folder, depth_unit=0.5))
            unit = json.loads((pathlib.Path(folder) / "meta.json").read_text())["depth_unit_mm"]
            self.assertGreater(plain.depth.max(), 0)
            numpy.testing.assert_allclose(scaled.depth, plain.depth * (0.5 / unit), rtol=1e-5)

    def test_frames_that_cannot_be_read_are_listed(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ["SACCADE_PROGRAM"], "export", "synthetic:cone?size=64x48&frames=3",
                            "--out", folder, "--quiet"], check=True)
            depth = sorted(pathlib.Path(folder).glob("*_depth.png"))
            depth[1].write_bytes(depth[1].read_bytes()[:60])
            colour = sorted(pathlib.Path(folder).glob("*_rgb.png"))
            colour[2].write_bytes(b"")
            source = saccade.open(folder)
            frames = list(source)
            self.assertEqual([frame.index for frame in frames], [0, 2])
            self.assertEqual([index for index, reason in source.rejected if reason], [1])
            self.assertEqual(frames[0].problem, "")
            self.assertIn("colour", frames[1].problem)
            self.assertIsNone(frames[1].colour)

    def test_threads_share_a_source(self):
        source, seen = saccade.open("synthetic:cone?size=64x48&frames=40"), []
        threads = [threading.Thread(target=lambda: seen.extend(frame.index for frame in source)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(sorted(seen), list(range(40)))

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
        for setting in ({"dump": "none"}, {"start": 3}, {"quiet": True}):
            with self.assertRaisesRegex(ValueError, "no effect here"):
                saccade.Saliency(**setting)
        with self.assertRaisesRegex(ValueError, "no effect here"):
            saccade.open(RECORDING, kernel=3)
        with self.assertRaisesRegex(ValueError, "every at least 1"):
            saccade.open(RECORDING, every=0)
        with self.assertRaisesRegex(ValueError, "past the last"):
            saccade.open(RECORDING, start=10**6)
        with self.assertRaisesRegex(TypeError, "str, bytes or os.PathLike"):
            saccade.open(3)
        self.assertEqual(saccade.Error.__module__, "saccade")

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

    def test_a_fork_is_refused(self):
        depth = next(saccade.open(RECORDING)).depth
        saliency = saccade.Saliency(workers=2)
        saliency.compute(depth)
        child = os.fork()
        if child == 0:
            try:
                saliency.compute(depth)
            except ValueError as error:
                refused = "before the process forked" in str(error)
                del saliency
                os._exit(0 if refused and saccade.Saliency(workers=2).compute(depth).map.max() > 0 else 1)
            os._exit(2)
        self.assertEqual(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), 0)


class Texts(unittest.TestCase):
    def test_every_class_has_help_and_types(self):
        stub = (HOME / "src/python/package/__init__.pyi").read_text()
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
