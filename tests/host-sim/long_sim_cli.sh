#!/usr/bin/env bash
# What tests/host-sim/test_sim_cli.sh looks at a few of, all of it; SHARE takes a share of the checks.
LONG=1 exec "$(dirname "$0")/test_sim_cli.sh"
