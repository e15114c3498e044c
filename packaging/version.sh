#!/usr/bin/env bash
# Prints the version of the project.
# usage: packaging/version.sh
sed -n 's/^project(sikku VERSION \([0-9.]*\).*/\1/p' "$(dirname "$0")/../CMakeLists.txt"
