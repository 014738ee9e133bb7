#!/usr/bin/env python3
"""A mesh file has the same bytes however many processors wrote it.

  mesh_bytes_test.py AXIL
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

AXIL = str(pathlib.Path(sys.argv[1]).resolve())

# 8,191 segments and as many leaves: enough for every part of the work to be shared out.
TREE = """Lsystem: tree
derivation length: 13
Axiom: A(1,0.2)
A(l,w) --> !(w)F(l)[&(45)B(l*0.6,w*0.707)]/(137.5)A(l*0.9,w*0.707)
B(l,w) --> !(w)F(l)L[-(45)@vC(l*0.6,w*0.707)]C(l*0.9,w*0.707)
C(l,w) --> !(w)F(l)L[+(45)@vB(l*0.6,w*0.707)]B(l*0.9,w*0.707)
homomorphism
L --> [&(60){.+(20)f(0.1)-(20)f(0.1)-(20)f(0.1)+(20)+(160)f(0.1)-(20)f(0.1)}]~l(0.1)
endlsystem
"""


class MeshBytes(unittest.TestCase):
    def grown(self, ending, processors):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder) / "tree.l"
            tree.write_text(TREE)
            out = tree.with_suffix(ending)
            run = subprocess.run([AXIL, "grow", tree, "-o", out], capture_output=True, text=True, preexec_fn=lambda: os.sched_setaffinity(0, processors))
            self.assertEqual(run.returncode, 0, run.stderr)
            return out.read_bytes()

    def test_one_processor_writes_what_all_write(self):
        every = os.sched_getaffinity(0)
        if len(every) == 1:
            self.skipTest("there is one processor only")
        for ending in (".glb", ".obj", ".ply"):
            one = self.grown(ending, {min(every)})
            self.assertGreater(len(one), 1_000_000)
            self.assertTrue(one == self.grown(ending, every), ending)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
