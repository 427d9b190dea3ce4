"""Units for one set of instructions define no function that another unit could be given by the linker.

    python3 instruction_sets_test.py OBJECT...

A function that several units define is kept once, from any of them. If it came from one that is compiled for AVX, a
processor without AVX would stop there. So what such a unit defines weakly has its number of lanes in its name, which no
other unit has.
"""

import os
import re
import subprocess
import sys
import unittest

LANES = {"avx2": 4, "avx512": 8}  # doubles; twice as many floats


def units(objects):
    """(path, lanes) of the objects that are compiled for a set of instructions."""
    for path in objects:
        found = re.search(r"_(avx2|avx512)\.cpp\.o$", os.path.basename(path))
        if found:
            yield path, LANES[found.group(1)]


def shared_names(listing, lanes):
    """The weak definitions in the output of nm that do not name the lanes."""
    weak = re.findall(r"^[0-9a-f]+ [WVu] (.+)$", listing, re.MULTILINE)
    # The last parameter of a Taylor model is its degree.
    lane = re.compile(rf"(?<!float)(?:<|, ){lanes}>|float, {2 * lanes}>")
    return [name for name in weak
            if not name.startswith("DW.ref.") and not lane.search(re.sub(r"TaylorModel<\d+, \d+>", "", name))]


class InstructionSetsTest(unittest.TestCase):
    objects = []

    def test_names_of_functions_for_one_set(self):
        found = list(units(self.objects))
        self.assertGreaterEqual(len(found), 4)
        for path, lanes in found:
            with self.subTest(unit=os.path.basename(path)):
                listing = subprocess.run(["nm", "-C", path], check=True, capture_output=True, text=True).stdout
                self.assertEqual(shared_names(listing, lanes), [])

    def test_a_shared_name_is_seen(self):
        listing = "00 W std::vector<double>::size() const\n10 W f<8>(double)\n20 T g()\n U h()\n"
        self.assertEqual(shared_names(listing, 8), ["std::vector<double>::size() const"])

    def test_floats_are_twice_as_many(self):
        listing = "00 W f<float, 8>(float)\n10 W f<float, 4>(float)\n"
        self.assertEqual(shared_names(listing, 4), ["f<float, 4>(float)"])

    def test_a_degree_is_no_number_of_lanes(self):
        listing = "00 W g<TaylorModel<2, 4> >()\n10 W g<TaylorLanes<2, 4, 4> >()\n"
        self.assertEqual(shared_names(listing, 4), ["g<TaylorModel<2, 4> >()"])


if __name__ == "__main__":
    InstructionSetsTest.objects = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
