#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws the gallery:  draw.sh PROGRAM [FOLDER [NAME...]]     (all recipes when none is named)
set -eu
program=$(realpath "$1")
folder=${2:-plots}
shift $(($# < 2 ? $# : 2))
grep -v '^#' "$(dirname "$0")/recipes" | while read -r name arguments; do
    case " $* " in '  ' | *" $name "*) ;; *) continue ;; esac
    case $arguments in 'render '*) ending=png ;; *) ending=svg ;; esac
    echo "  PLOT    $folder/$name.$ending"
    # A recipe is words without quotes or patterns.
    # shellcheck disable=SC2086
    case $arguments in
    'render '*) "$program" scene ${arguments#render } --render "$folder/$name.png" --json >/dev/null ;;
    'texture '*) "$program" $arguments --figure "$folder/$name.svg" ;;
    'sensor '*) # its lattice, then a file of millimetres
        work=$(mktemp -d)
        (cd "$work" && "$program" texture ${arguments#sensor } --product eye -q -o z.npy &&
            "$program" texture z.npy --metric 1m --product eye --as even:0.001 -q -o camera.npy &&
            "$program" texture camera.npy --metric 1m --title "Millimetres of a disparity sensor" --histogram "$name.svg")
        mv "$work/$name.svg" "$folder"
        rm -r "$work" ;;
    *) "$program" plot $arguments -o "$folder/$name.svg" ;;
    esac
done
