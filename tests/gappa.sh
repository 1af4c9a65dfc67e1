#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The bounds of `methods linearize` against those that Gappa proves of the same operations: an independent judge. Writes
# a script for each method and camera to gappa/ in the build folder, with or without Gappa here.
. tests/tap.sh

folder=$B/gappa
mkdir -p "$folder"
cameras='0.1:1000 0.25:64'
[ -z "${DEPTHPREC_FULL-}" ] || cameras='0.1:1000 3:500 0.25:64 0.01:20000 1:65536 0.05:150'

# The octaves of d and those of 1 - d.
pieces=$(awk 'BEGIN {
    for (k = 24; k > 1; k--) printf "1b-%d, ", k
    for (k = 1; k < 24; k++) printf "%db-%d, ", 2 ^ k - 1, k
    print 16777215 "b-24" }')

# The constants as engines form them, the steps, and Z, which is exact. The share towards near is `near` exactly and `q`
# as it is computed, by `towards`; the other one is `away`, `rest` and `from`.
steps() { # steps METHOD MAPPING
    if [ "$2" = reversed ]; then
        near=d away='(1 - d)' q=d towards= from='rest rnd= 1 - d;' rest=rest base=n width='(f - n)' sign=
        eye=1/f first=1 first_exact=1
    else
        near='(1 - d)' away=d q=q towards='q rnd= 1 - d;' from= rest=d base=f width='(n - f)' sign=-
        eye=1/n first='rnd(dbl(f/n))' first_exact=f/n
    fi
    across='dbl(dbl(dbl(f - n)/n)/f)' excess='dbl(dbl(f - n)/n)'
    textbook="P = rnd(dbl(n*f)); B = rnd($base); S = rnd(dbl($width));"
    complement="P = rnd(dbl(n*f)); B = rnd(n); S = rnd(dbl(f - n)); $towards x rnd= B + S*$q;"
    unity="B = rnd(dbl($eye)); S = ${sign}rnd($across); x rnd= B + S*d;"
    share="F = rnd(f); N = rnd(n); W = rnd(dbl(f - n)); B = $first; S = ${sign}rnd($excess); x rnd= B + S*d;"
    newton='y = rnd(yy); t rnd= x*y; u rnd= 2 - t;'
    by_textbook="X = $base + $width*d; Z = n*f/X;"
    by_complement="X = n + (f - n)*$near; Z = n*f/X;"
    by_unity="X = $eye + (${sign}(1/n - 1/f))*d; Z = 1/X;"
    by_share="X = $first_exact + (${sign}((f - n)/n))*d;"
    case $1 in
    magic) echo "$unity $newton z rnd= y*u; $by_unity" ;;
    unity) echo "$unity z rnd= 1/x; $by_unity" ;;
    complement-unity)
        echo "B = rnd(dbl(1/f)); S = rnd($across); $towards x rnd= B + S*$q; z rnd= 1/x;"
        echo "X = 1/f + (1/n - 1/f)*$near; Z = 1/X;"
        ;;
    linear-01) echo "$share z rnd= F*(1/x); $by_share Z = f*(1/X);" ;;
    linear-01-near) echo "$share $from z rnd= N + W*($rest/x); $by_share Z = n + (f - n)*($away/X);" ;;
    textbook) echo "$textbook x rnd= B + S*d; z rnd= P/x; $by_textbook" ;;
    fused) echo "$textbook x = rnd(B + S*d); z rnd= P/x; $by_textbook" ;;
    complement) echo "$complement z rnd= P/x; $by_complement" ;;
    complement-newton) echo "$complement $newton v rnd= y*u; z rnd= P*v; X = n + (f - n)*$near; Z = n*f*(1/X);" ;;
    double) echo "P = dbl(n*f); S = dbl($width); x dbl= $base + S*d; z = rnd(dbl(P/x)); $by_textbook" ;;
    phi-double)
        echo "p = dbl(n/f); q dbl= 1 - d;"
        [ "$2" = reversed ] && echo 'x dbl= p*q + d; X = (n/f)*(1 - d) + d;' || echo 'x dbl= p*d + q; X = (n/f)*d + (1 - d);'
        echo 'z = rnd(dbl(n/x)); Z = n/X;'
        ;;
    esac
}

# An estimated reciprocal is known by its error alone; a Newton step squares it.
script() { # script METHOD MAPPING NEAR FAR
    estimate=
    case $1 in magic) estimate=0.05052 ;; complement-newton) estimate=3b-13 ;; esac
    cat <<END
# $1, $2, near $3, far $4: the relative error of the eye depth z
@rnd = float<ieee_32, ne>;
@dbl = float<ieee_64, ne>;
n = dbl($3);
f = dbl($4);
d = rnd(any);
$(steps "$1" "$2")
{ d in [0, 1] ${estimate:+/\\ (y - 1/x)/(1/x) in [-$estimate, $estimate]} -> z -/ Z in ? }
${estimate:+(y*(2 - x*y) - 1/x)/(1/x) -> -((y - 1/x)/(1/x))*((y - 1/x)/(1/x)) {x <> 0\};}
\$ d in ($pieces);
END
}

proven() { # proven SCRIPT: the greater end of what Gappa says
    gappa "$1" 2>&1 | awk -F'[{,]' '/z -\/ Z in \[/ {
        lo = -$2; for (i = 3; i <= NF; i++) if ($i ~ /^-?[0-9.]+(e-?[0-9]+)?$/) hi = $i
        print (lo > hi ? lo : hi); found = 1 }
        END { if (!found) print "nothing" }'
}

# Each method that has a bound: its script, Gappa's bound where Gappa is here, and the three numbers compared. What has
# no script must come so near to the worst error found that no proof could be much better.
judge() { # judge NEAR FAR MAPPING
    "$DEPTHPREC" methods linearize -n "$1" -f "$2" -F fp32 -m "$3" --json >"$scratch/bench" || return 1
    jq -r '.methods[] | select(.bound != null) | "\(.name) \(.error) \(.bound)"' "$scratch/bench" >"$scratch/rows" ||
        return 1
    while read -r method error bound; do
        file=$folder/$method-$3-$1-$2.g proven=$error
        if [ "$method" != pair ]; then
            script "$method" "$3" "$1" "$2" >"$file"
            ! command -v gappa >/dev/null || proven=$(proven "$file")
        fi
        echo "$method $error $bound $proven"
    done <"$scratch/rows" >"$scratch/compared"
    awk -v gappa="$(command -v gappa)" -v where="$3, near $1, far $2" '
        { proven = gappa != "" || $1 == "pair"
          if (proven) printf "%s, %s: found %.4g, bound %.4g, proven %.4g: %.3f of it\n", $1, where, $2, $3, $4, $3 / $4
          if (!($2 <= $3) || (proven && !($4 > 0 && $2 <= $4 && $3 <= 1.1 * $4))) { print $1 ": not so"; bad = 1 } }
        END { exit bad || NR < 11 }' "$scratch/compared" >"$scratch/said"
    status=$?
    cat "$scratch/said"
    return $status
}

for camera in $cameras; do
    for mapping in d3d reversed; do
        what="bounds of linearizations, $mapping, near ${camera%:*}, far ${camera#*:}: at most 1.1 times what Gappa proves"
        check "$what" judge "${camera%:*}" "${camera#*:}" "$mapping"
        [ ! -s "$scratch/said" ] || sed 's/^/# /' "$scratch/said"
    done
done
command -v gappa >/dev/null || skip "what Gappa proves" "no gappa here"
finish
