#!/usr/bin/env python3
"""`axil keywords` as its users run it: every option, files in all encodings, and input that is none.

  keywords_test.py AXIL SOURCE_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

AXIL = pathlib.Path(sys.argv[1])
SOURCES = pathlib.Path(sys.argv[2])


def axil(*words, given=b""):
    done = subprocess.run([str(AXIL), "keywords", *map(str, words)], input=given, capture_output=True, timeout=120, check=False)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def reading(text):
    status, out, err = axil("-", "--json", given=text.encode() if isinstance(text, str) else text)
    assert status == 0, err
    return json.loads(out)


def facts(text):
    return {(t["organ"], t["property"], t.get("value", (t.get("low"), t.get("high"), t.get("unit")))) for t in reading(text)["traits"]}


class Options(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())

    def write(self, name, data):
        path = self.folder / name
        path.write_bytes(data)
        return path

    def test_a_file_and_standard_input_say_the_same(self):
        text = "Leaves opposite, ovate, 3-8 cm long; petals 5.".encode()
        self.assertEqual(axil(self.write("d.txt", text)), axil("-", given=text))

    def test_json_quotes_the_words_and_their_place(self):
        text = "灌木；葉對生，卵形，長3-8公分。"
        for trait in reading(text)["traits"]:
            self.assertEqual(text[trait["start"]:trait["end"]], trait["text"])

    def test_json_names_the_words_behind_every_preset(self):
        got = reading("Leaves opposite, ovate, 3-8 cm long, serrate; corolla purple; capsule 1 cm.")
        self.assertTrue(got["presets"])
        self.assertIn("opposite", json.dumps(got["presets"]))

    def test_people_get_lines(self):
        status, out, err = axil("-", given=b"Leaves opposite, ovate.")
        self.assertEqual((status, err), (0, ""))
        self.assertIn("opposite", out)
        self.assertNotIn("{", out)

    def test_neither_a_file_nor_a_gallery_is_bad_usage(self):
        status, out, err = axil()
        self.assertEqual((status, out), (2, ""))
        self.assertIn("FILE", err)

    def test_a_gallery_reads_no_file(self):
        self.assertEqual(axil("-", "--gallery", self.folder / "g.png")[0], 2)

    def test_an_unknown_option_is_bad_usage(self):
        self.assertEqual(axil("-", "--jsn")[0], 2)

    def test_help_shows_an_example(self):
        status, out, _ = axil("--help")
        self.assertEqual(status, 0)
        for word in ("--json", "--gallery", "description.txt"):
            self.assertIn(word, out)

    # ---- encodings: one sentence in each

    def test_every_encoding_reads_alike(self):
        traditional = "葉對生，卵形，長3至8公分，鋸齒緣。"
        simplified = "叶对生，卵形，长3至8厘米，边缘有锯齿。"
        wanted = {("leaf", "arrangement", "opposite"), ("leaf", "shape", "ovate"), ("leaf", "length", (3, 8, "cm")), ("leaf", "margin", "serrate")}
        for text, encoding in ((traditional, "utf-8"), (traditional, "utf-8-sig"), (traditional, "utf-16"), (traditional, "big5"), (simplified, "gb18030"), (simplified, "utf-16")):
            self.assertEqual(facts(text.encode(encoding)), wanted, encoding)

    def test_lines_of_several_encodings(self):
        mixed = "葉對生。\n".encode("big5") + "花瓣5枚。\n".encode() + "边缘有锯齿，叶卵形。\n".encode("gb18030")
        got = facts(mixed)
        for fact in (("leaf", "arrangement", "opposite"), ("leaf", "shape", "ovate"), ("petal", "count", (5, 5, None))):
            self.assertIn(fact, got)

    # ---- what is no description

    def test_what_is_no_text_is_refused_in_one_sentence(self):
        for data, says in ((b"", "empty"), (b" \n\t", "empty"), (bytes(range(256)) * 4, "no text"), (b"\x89PNG\r\n\x1a\n\0\0", "no text"), (b"\xff\xfe\x00", "")):
            status, out, err = axil("-", given=data)
            self.assertEqual((status, out), (1, ""), data[:10])
            self.assertIn(says, err)
            self.assertEqual(len(err.strip().splitlines()), 1, err)

    def test_a_file_that_is_not_there_and_a_folder(self):
        for path in (self.folder / "none.txt", self.folder):
            status, out, err = axil(path)
            self.assertEqual((status, out), (1, ""))
            self.assertIn(str(path), err)

    def test_a_text_of_any_length_is_read_in_pieces(self):
        text = "Leaves opposite, ovate.\n" + "\n" * 21_000_000 + "葉對生，farinulent，卵形。Petals 5 mm long.\n"
        for status, out, err in (axil("-", "--json", given=text.encode()), axil(self.write("long.txt", text.encode()), "--json")):
            self.assertEqual((status, err), (0, ""))
            got = json.loads(out)
            self.assertEqual([t["text"] for t in got["traits"]][-1], "5 mm long")
            for trait in got["traits"]:
                self.assertEqual(text[trait["start"]:trait["end"]], trait["text"])
            self.assertEqual(got["presets"], {})
        self.assertIn("5 mm long", axil("-", given=text.encode())[1])

    def test_what_cannot_be_read_in_pieces_is_refused_in_one_sentence(self):
        big5 = "葉對生，".encode("big5") * 2_700_000  # one line
        for data in (("\n" * 11_000_000).encode("utf-16"), big5, bytes(range(256)) * 90_000):
            status, out, err = axil("-", given=data)
            self.assertEqual((status, out), (1, ""))
            self.assertEqual(len(err.strip().splitlines()), 1, err)

    def test_traits_carry_the_ids_of_organ_and_value(self):
        trait = reading("Leaves opposite.")["traits"][0]
        self.assertEqual((trait["organ_id"], trait["id"], trait["value"], trait["text"]), ("PO:0025034", "PATO:0001933", "opposite", "opposite"))

    def test_the_vocabulary_lists_every_name_with_its_words(self):
        status, out, _ = axil("--vocabulary")
        self.assertEqual(status, 0)
        rows = [line.split("\t") for line in out.splitlines()]
        self.assertEqual({len(row) for row in rows}, {8})
        opposite = next(row for row in rows if row[:3] == ["arrangement", "leaf", "opposite"])
        self.assertIn("對生", opposite[5])
        self.assertGreater(len(rows), 290)

    def test_one_endless_line_is_read_to_its_end(self):
        got = reading("葉互生" + "，卵形" * 60_000 + "。花瓣5枚。")
        self.assertIn(("petal", "count", 5), {(t["organ"], t["property"], t.get("low")) for t in got["traits"]})

    def test_endless_numbers_and_brackets_take_no_longer(self):
        for piece in ("十二百", "3-", "(", "(1-)", "至", "petals 5, ", "或", "5 × "):
            self.assertEqual(axil("-", given=("葉卵形。" + piece * 60_000).encode())[0], 0, piece)

    # ---- what is said of a text

    def test_contradictions_are_kept_and_flagged(self):
        got = reading("Leaves opposite. Leaves alternate.")
        self.assertEqual(len([t for t in got["traits"] if t["property"] == "arrangement"]), 2)
        self.assertEqual(len(got["contradictions"]), 1)

    def test_terms_that_are_not_understood_are_listed(self):
        self.assertIn("farinulent", json.dumps(reading("Leaves ovate, farinulent, glabrous.")))

    def test_what_is_about_something_else_says_nothing(self):
        for paragraph in (SOURCES / "tests/keywords/corpus/not_plants.txt").read_text(encoding="utf-8").splitlines()[::40]:
            self.assertEqual(reading(paragraph)["traits"], [], paragraph)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
