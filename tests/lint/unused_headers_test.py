#!/usr/bin/env python3
"""Which headers unused_headers.py finds."""
import unittest

from unused_headers import unused_headers

FILES = {
    "lib/simulator/world/world.h": "",
    "lib/simulator/world/world.cpp": '#include "world/world.h"\n#include "base/text.h"\n',
    "lib/simulator/world/world_test.cpp": '#include "base/other.h"\n',
    "lib/foundation/base/text.h": "",
    "lib/foundation/base/other.h": "",
    "lib/foundation/base/testing/reference.h": "",
    "lib/controller/aria/aria.h": "",
}


class UnusedHeaders(unittest.TestCase):
    def test_are_those_that_only_their_own_file_or_tests_include(self):
        self.assertEqual(unused_headers(FILES, {"aria/aria.h"}),
                         ["lib/foundation/base/other.h", "lib/simulator/world/world.h"])

    def test_are_not_those_for_users(self):
        self.assertIn("lib/controller/aria/aria.h", unused_headers(FILES, set()))


if __name__ == "__main__":
    unittest.main()
