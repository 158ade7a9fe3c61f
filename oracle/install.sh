#!/bin/sh
# Installs what the oracles need on Debian: CGAL and TetGen (apt), numpy, Triangle and Gmsh (pip). Run as root, or with sudo installed.
set -eu
as_root() { if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi; }
as_root apt-get update
as_root apt-get install -y --no-install-recommends g++ libcgal-dev libgmp-dev libmpfr-dev tetgen libglu1-mesa python3 time
# Triangle's licence forbids commercial use, TetGen's is AGPL, Gmsh's GPL: peers installed beside the project, never a part of it.
python3 -m pip install --quiet numpy triangle gmsh
