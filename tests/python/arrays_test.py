"""Bad arrays are refused with a sentence, good ones are not copied."""

import unittest

import numpy
import saccade

DEPTH = next(saccade.open("synthetic:table?size=160x120")).depth.round().astype(numpy.uint16)


class BadArrays(unittest.TestCase):
    def refuse(self, error, text, *arguments, **options):
        with self.assertRaisesRegex(error, text):
            saccade.Saliency(levels="0..1", workers=1).compute(*arguments, **options)

    def test_type(self):
        self.refuse(TypeError, "depth must be a numpy array .*, not list", [[1, 2], [3, 4]])
        self.refuse(TypeError, "depth must be of dtype uint16 or float32, in mm, not float64", DEPTH.astype(float))
        self.refuse(TypeError, "not >u2", DEPTH.astype(">u2"))
        self.refuse(TypeError, "colour must be of dtype uint8", DEPTH, numpy.zeros((120, 160, 3)))

    def test_shape(self):
        self.refuse(ValueError, r"shape \(height, width\), not \(120, 160, 1\)", DEPTH[..., None])
        self.refuse(ValueError, "depth is empty", DEPTH[:0])
        self.refuse(ValueError, r"shape \(120, 160, 3\) of the depth, not \(120, 160\)", DEPTH, DEPTH.astype("u1"))
        self.refuse(saccade.Error, "too small", DEPTH[:4].copy())
        self.refuse(ValueError, "too large: 9000x8 is larger than 8192", numpy.zeros((8, 9000), numpy.uint16))

    def test_memory(self):
        self.refuse(ValueError, r"depth is not contiguous and aligned in memory; pass depth.copy\(\)", DEPTH[:, ::2])
        self.refuse(ValueError, "not contiguous", numpy.asfortranarray(DEPTH))
        shifted = numpy.frombuffer(b"\0" + DEPTH.tobytes(), numpy.uint16, offset=1).reshape(DEPTH.shape)
        self.refuse(ValueError, "not contiguous and aligned", shifted)
        self.refuse(TypeError, r"masked array; pass depth.filled\(0\)", numpy.ma.masked_equal(DEPTH, 0))

    def test_values(self):
        for bad in (numpy.nan, numpy.inf, -1):
            depth = DEPTH.astype(numpy.float32)
            depth[7, 11] = bad
            self.refuse(ValueError, "at row 7, column 11; where there is no reading it must be 0", depth)

    def test_values_written_into_a_frame(self):
        frame = next(saccade.open("synthetic:table?size=160x120"))
        frame.depth[7, 11] = numpy.nan
        self.refuse(ValueError, "depth has the value nan at row 7, column 11", frame)

    def test_camera(self):
        for bad in ((0, 525, 80, 60), (525, 525), 525, (525, 525, numpy.nan, 60), "abcd"):
            self.refuse(ValueError, r"camera must be \(fx, fy, cx, cy\)", DEPTH, camera=bad)

    def test_time(self):
        self.refuse(ValueError, "timestamp_us must not be negative", DEPTH, timestamp_us=-1)


class GoodArrays(unittest.TestCase):
    def test_the_largest_number_is_no_reading(self):
        full, empty = DEPTH.copy(), DEPTH.copy()
        full[40:80, 50:90], empty[40:80, 50:90] = 65535, 0
        saliency = saccade.Saliency(levels="0..1", workers=1)
        self.assertEqual(saliency.compute(full).map.tobytes(), saliency.compute(empty).map.tobytes())
        self.assertEqual(full[50, 60], 65535)

    def test_arrays_that_cannot_be_written(self):
        locked = DEPTH.astype(numpy.float32)
        locked.flags.writeable = False
        saliency = saccade.Saliency(levels="0..1", workers=1)
        self.assertEqual(saliency.compute(locked).map.tobytes(), saliency.compute(DEPTH).map.tobytes())

    def test_both_types_give_the_same(self):
        saliency = saccade.Saliency(levels="0..1", workers=1)
        a, b = saliency.compute(DEPTH), saliency.compute(DEPTH.astype(numpy.float32))
        self.assertEqual(a.map.tobytes(), b.map.tobytes())
        self.assertEqual(a.map.shape, (120, 160))
        self.assertGreater(a.map.max(), 0)

    def test_results_are_not_copied_and_outlive_the_result(self):
        result = saccade.Saliency(levels="0..1", workers=1, level_maps=True, normals=True).compute(DEPTH)
        first, second = result.map, result.map
        self.assertTrue(numpy.shares_memory(first, second))
        self.assertEqual([level.shape for level in result.level_maps], [(120, 160), (60, 80)])
        self.assertEqual(result.normals.shape, (120, 160, 3))
        before = first.copy()
        del result, second
        self.assertTrue((first == before).all())

    def test_frames_are_not_copied_and_do_not_share_memory(self):
        one, two = saccade.open("synthetic:table?size=160x120&frames=2")
        self.assertTrue(numpy.shares_memory(one.depth, one.depth))
        self.assertFalse(numpy.shares_memory(one.depth, two.depth))
        self.assertFalse(numpy.shares_memory(one.colour, two.colour))
        depth = one.depth
        del one
        self.assertTrue((depth == next(saccade.open("synthetic:table?size=160x120")).depth).all())


if __name__ == "__main__":
    unittest.main()
