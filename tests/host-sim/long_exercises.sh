#!/usr/bin/env bash
# The exercises of the page's lesson: 1,000 instances of each, 8 of each against pinhole-sim, and every chapter's address.
cd "$(dirname "$0")" && LONG=1 exec ./test_exercises.sh
