#!/bin/sh
# The work that test_progress.sh leaves out.
LONG=1 exec "$(dirname "$0")/test_progress.sh"
