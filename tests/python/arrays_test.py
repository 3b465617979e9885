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

    def test_memory(self):
        self.refuse(ValueError, "depth is not contiguous in memory; pass numpy.ascontiguousarray", DEPTH[:, ::2])
        self.refuse(ValueError, "not contiguous", numpy.asfortranarray(DEPTH))

    def test_values(self):
        for bad in (numpy.nan, numpy.inf, -1):
            depth = DEPTH.astype(numpy.float32)
            depth[7, 11] = bad
            self.refuse(ValueError, "at row 7, column 11; where there is no reading it must be 0", depth)

    def test_camera(self):
        self.refuse(ValueError, "camera must be", DEPTH, camera=(0, 525, 80, 60))


class GoodArrays(unittest.TestCase):
    def test_both_types_give_the_same(self):
        saliency = saccade.Saliency(levels="0..1", workers=1)
        a, b = saliency.compute(DEPTH), saliency.compute(DEPTH.astype(numpy.float32))
        self.assertEqual(a.map.tobytes(), b.map.tobytes())
        self.assertEqual(a.map.shape, (120, 160))
        self.assertGreater(a.map.max(), 0)

    def test_results_are_not_copied_and_outlive_the_result(self):
        result = saccade.Saliency(levels="0..1", workers=1).compute(DEPTH, level_maps=True, normals=True)
        first, second = result.map, result.map
        self.assertTrue(numpy.shares_memory(first, second))
        self.assertEqual([level.shape for level in result.level_maps], [(120, 160), (60, 80)])
        self.assertEqual(result.normals.shape, (120, 160, 3))
        before = first.copy()
        del result, second
        self.assertTrue((first == before).all())


if __name__ == "__main__":
    unittest.main()
