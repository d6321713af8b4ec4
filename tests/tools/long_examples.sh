#!/usr/bin/env bash
# All examples with every compiler, at every level, under sanitizers and in 32 bits: see test_example_programs.sh.
cd "$(dirname "$0")/../.." && LONG=1 exec tests/tools/test_example_programs.sh
