"""The reader of our EXR files and the writer of PFM files."""
import pathlib
import struct
import unittest

import numpy as np
from support import compared, require_driver, work

import umbrameter as um
from umbrameter import Layers
from umbrameter.exr import write_pfm


class Exr(unittest.TestCase):
    def test_the_mean_error_of_the_layers_is_that_of_the_summary(self):
        run_ = compared()
        error = run_.layers["error_visibility_sun"]
        counted = run_.layers["class_sun"] <= 4
        self.assertEqual(counted.sum(), run_.summary["shadows"][0]["pixels"]["counted"])
        self.assertAlmostEqual(float(abs(error[counted]).mean(dtype=float)), run_.summary["shadows"][0]["statistics"]["mae"], 7)

    def test_layers_have_their_shapes_and_row_0_is_the_top(self):
        layers = compared().layers
        self.assertEqual(layers.shape, (54, 96))
        self.assertEqual({name: layers[name].shape for name in ("RGBA", "Z", "gbuffer_normal", "truth_ao")},
                         {"RGBA": (54, 96, 4), "Z": (54, 96), "gbuffer_normal": (54, 96, 3), "truth_ao": (54, 96)})
        # The camera looks down at the floor: the far background or floor is at the top.
        depth = np.where(np.isnan(layers["gbuffer_position"][..., 0]), np.inf, layers["Z"])
        self.assertGreater(depth[0].min(), depth[-1].min())
        self.assertEqual(layers.attributes["umbrameter.scene"], "contact-box")
        self.assertEqual(set(layers.descriptions) - set(layers), set())
        self.assertEqual(layers.descriptions["truth_ao"]["title"], "Reference")

    def test_one_pass_reads_the_same_as_one_layer_after_the_other(self):
        path = compared().folder / "images.exr"
        together = Layers(path)
        together.load()
        for name in Layers(path):
            np.testing.assert_array_equal(Layers(path)[name], together[name])

    def test_half_floats_and_uncompressed_chunks_are_read(self):
        path = work / "half.exr"
        values = np.arange(6, dtype="<f2").reshape(2, 3)
        head = struct.pack("<II", 20000630, 2)
        for name, kind, data in ((b"channels", b"chlist", b"a.Y\0" + struct.pack("<iIii", 1, 0, 1, 1) + b"\0"),
                                 (b"compression", b"compression", b"\0"),
                                 (b"dataWindow", b"box2i", struct.pack("<4i", 5, 7, 7, 8))):
            head += name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
        head += b"\0"
        chunks = [struct.pack("<iI", 7 + row, 6) + values[row].tobytes() for row in range(2)]
        first = len(head) + 16
        path.write_bytes(head + struct.pack("<2Q", first, first + len(chunks[0])) + b"".join(chunks))
        np.testing.assert_array_equal(Layers(path)["a"], values)

    def test_what_is_no_such_file_is_refused_with_its_path(self):
        content = (compared().folder / "images.exr").read_bytes()
        zip_ = b"compression\0compression\0\1\0\0\0\3"
        self.assertIn(zip_, content)
        files = {"text": b"no image at all, but text", "short": content[:40], "empty": b"",
                 "piz": content.replace(zip_, zip_[:-1] + b"\4")}
        for name, data in files.items():
            path = pathlib.Path(work / f"{name}.exr")
            path.write_bytes(data)
            with self.assertRaisesRegex(ValueError, f"{name}.exr"):
                Layers(path)
        damaged = work / "damaged.exr"
        damaged.write_bytes(content[:len(content) // 2])
        with self.assertRaisesRegex(ValueError, "damaged.exr"):
            Layers(damaged).load()
        with self.assertRaisesRegex(KeyError, "no layer 'truth'; it has RGBA"):
            compared().layers["truth"]


class Pfm(unittest.TestCase):
    def test_the_program_reads_what_is_written(self):
        write_pfm(work / "a.pfm", np.array([[0, 0.25], [1, 0.5]]))
        self.assertEqual((work / "a.pfm").read_bytes(), b"Pf\n2 2\n-1.0\n" + struct.pack("<4f", 1, 0.5, 0, 0.25))
        layer = compared().layers["truth_ao"]
        write_pfm(work / "ao.pfm", layer)
        same = um.diff(work / "ao.pfm", compared().folder / "images.exr", reference_layer="truth_ao", data=True)
        self.assertEqual(same.scores["mae"], 0)

    def test_what_is_no_image_is_refused(self):
        for shape in ((3,), (2, 2, 2), (0, 4), (2, 2, 3, 1)):
            with self.assertRaisesRegex(ValueError, "an image is"):
                write_pfm(work / "b.pfm", np.zeros(shape))


if __name__ == "__main__":
    require_driver()
    unittest.main()
