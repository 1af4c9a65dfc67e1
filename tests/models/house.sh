#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints a house in glTF 2.0, with surfaces that fight and surfaces that only look as if they did:
#     sh tests/models/house.sh [NODE=LENGTH...] >house.gltf
# moves nodes out of what they lie on, by a length in metres. tests/models/house.gltf is what it prints without.
# house-lifted.gltf what it prints with the lengths that depthprec scene asks for. tests/cli/test_values_house.c has the
# list of the fights, and of what must not be taken for one.
set -eu

# node | parent | mesh | material | place | turn | size | a metre outward, in the parent's lengths
rows() {
    cat <<'ROWS'
land           |       |      |          | 0 0 0           | slope  | 1 1 1
terrain street | land  | quad | asphalt  | 0 0 23          | up     | 80 30 1
garden west    | land  | quad | grass    | -20 0.001 -6    | up     | 40 30 1   | 0 1 0
garden east    | land  | quad | grass    | 20 0.001 -6     | up     | 40 30 1   | 0 1 0
skirt west     | land  | quad | earth    | 0 -0.499 -6     | east   | 30 1 1
skirt east     | land  | quad | earth    | 0 -0.499 -6     | west   | 30 1 1
road           | land  | quad | tar      | 0 0.002 20      | up     | 80 6 1    | 0 1 0
marking        | road  | quad | paint    | 0 0 0.001       |        | 1 0.05 1  | 0 0 1
house          |       |      |          | 0 0 0           | turned | 1 1 1
slab           | house | box  | concrete | 0 -0.1 0        |        | 13 0.8 9
parquet        | house | quad | oak      | 0 0.302 0       | up     | 11 7 1    | 0 1 0
front wall     | house | box  | plaster  | 0 1.8 4         |        | 12 3 0.3
back wall      | house | box  | plaster  | 0 1.8 -4        |        | 12 3 0.3
west wall      | house | box  | plaster  | -5.85 1.8 0     |        | 0.3 3 7.7
east wall      | house | box  | plaster  | 5.85 1.8 0      |        | 0.3 3 7.7
west gable     | house | tri  | plaster  | -6 3.3 0        | west   | 8.3 3.1 1
east gable     | house | tri  | plaster  | 6 3.3 0         | east   | 8.3 3.1 1
door           | house | box  | oak      | -3 1.3 4.05     |        | 1 2 0.2   | 0 0 1
shutters       | house | quad | oak      | 0 1.75 4.1515   |        | 0.5 1.25 1 | 0 0 1
windows        | house | quad | glass    | 0 2.85 4.153    |        | 0.5 0.5 1
signs          | house |      |          | 0 0 4.15        |        | 0.01 0.01 0.01
poster         | signs | quad | paper    | 120 160 0.1     |        | 100 140 1 | 0 0 100
frame          | signs | quad | tin      | 300 170 0.2     |        | 120 90 1  | 0 0 100
picture        | frame | quad | paper    | 0 0 0.1         |        | 0.8 0.8 1 | 0 0 100
roof front     | house | box  | slate    | 0 4.8 2.4       | fall   | 13 0.2 6
roof back      | house | box  | slate    | 0 4.8 -2.4      | rise   | 12.5 0.2 6
solar          | roof front | quad | silicon | 0.2 0.5075 0 | up     | 0.4 0.5 1 | 0 5 0
chimney        | house | box  | brick    | 3 6.4 -1.5      |        | 0.8 2.4 0.8
chimney cap    | house | box  | concrete | 3 7.7 -1.5      |        | 0.8 0.2 0.8
terrace        | house | box  | concrete | 1 -0.15 6.25    |        | 6 0.7 3.5
tiles          | house | quad | stone    | 1 0.201 6.25    | up     | 5.5 3 1   | 0 1 0
railing        | house | box  | steel    | 0 0.6 7.95      |        | 0.1 1 0.1 | 0 0 1
handrail       | house | box  | steel    | 1 1.15 7.95     |        | 5.1 0.1 0.1
pillar         | house | box  | plaster  | -1.6 1.75 7     |        | 0.4 3.1 0.4
beam           | house | box  | steel    | -1.6 1.5 7      |        | 0.2 2 0.2
conduit        | house | box  | steel    | -1.6 1.5 7.05   |        | 0.1 1 0.1
wing           | house |      |          | 10.5 0 0        |        | -1 1 1
wing body      | wing  | box  | plaster  | 0 1.05 0        |        | 6 3.1 6
wing roof      | wing  | box  | slate    | 0 2.7 0         |        | 6.4 0.2 6.4
wing poster    | wing  | quad | paper    | 1 1.4 3.00125   |        | 1.5 1 1   | 0 0 1
fence          |       | quad | wood     | -13 0.6 6       | turned | 6 1.2 1
ivy            | fence | quad | leaves   | 0.1 0 -0.001    | back   | 0.5 0.9 1 | 0 0 -1
street         |       | camera |        | -20 17 50       | look   | 1 1 1
front door     | house | camera |        | -3 1.7 9        |        | 1 1 1
ROWS
}

lifts=$(printf '%s\n' "$@")
export lifts
rows | LC_ALL=C awk -F ' *[|] *' '
    function join(a, b) { return a == "" ? b : a ",\n  " b }
    function triple(text) { gsub(/ /, ", ", text); return "[" text "]" }
    function list(name, text) { return ",\n" "\"" name "\": [\n  " text "\n]" }

    # The 64 digits of a data URI, from bytes.
    function byte(b) {
        held = held * 256 + b
        if (++holds == 3) {
            for (k = 262144; k >= 1; k /= 64)
                buffer = buffer substr(digits, int(held / k) % 64 + 1, 1)
            held = holds = 0
        }
        bytes++
    }
    function float(x, exponent, sign) { # a binary32, whose bits must suffice
        sign = x < 0 ? 128 : 0
        x = x < 0 ? -x : x
        exponent = x == 0 ? 0 : 127
        while (x >= 2) { x /= 2; exponent++ }
        while (x > 0 && x < 1) { x *= 2; exponent-- }
        x = x == 0 ? 0 : (x - 1) * 8388608
        byte(x % 256); byte(int(x / 256) % 256)
        byte(int(x / 65536) + exponent % 2 * 128); byte(sign + int(exponent / 2))
    }
    function accessor(kind, type, count, more) { # what was put since the last one
        views = join(views, "{\"buffer\": 0, \"byteOffset\": " from ", \"byteLength\": " bytes - from "}")
        accessors = join(accessors, "{\"bufferView\": " at ", \"componentType\": " kind ", \"type\": \"" type \
            "\", \"count\": " count more "}")
        while (bytes % 4) byte(0)
        from = bytes
        return at++
    }
    function vectors(text, more, n, v, i) {
        n = split(text, v, " ")
        for (i = 1; i <= n; i++) float(v[i])
        return accessor(5126, "VEC3", n / 3, more)
    }
    function indices(text, n, v, i) {
        n = split(text, v, " ")
        for (i = 1; i <= n; i++) byte(v[i])
        return accessor(5121, "SCALAR", n, "")
    }
    function mesh(name, lo, hi, corners, order, p) {
        p = vectors(corners, ", \"min\": [" lo "], \"max\": [" hi "]")
        shape[name] = "\"primitives\": [{\"attributes\": {\"POSITION\": " p "}, \"indices\": " indices(order)
    }
    function material(name, colour, more) {
        materials = join(materials, "{\"name\": \"" name "\", \"pbrMetallicRoughness\": {" \
            "\"baseColorFactor\": [" colour "]}" more "}")
        material_of[name] = material_count++
    }

    BEGIN {
        at = from = bytes = count = mesh_count = material_count = 0
        digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
        mesh("quad", "-0.5, -0.5, 0", "0.5, 0.5, 0", "-.5 -.5 0 .5 -.5 0 .5 .5 0 -.5 .5 0", "0 1 2 0 2 3")
        mesh("tri", "-0.5, 0, 0", "0.5, 1, 0", "-.5 0 0 .5 0 0 0 1 0", "0 1 2")
        mesh("box", "-0.5, -0.5, -0.5", "0.5, 0.5, 0.5",
            "-.5 -.5 -.5 .5 -.5 -.5 -.5 .5 -.5 .5 .5 -.5 -.5 -.5 .5 .5 -.5 .5 -.5 .5 .5 .5 .5 .5",
            "0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5")
        instances["shutters"] = vectors("-10 0 0 -2.5 0 0 8.5 0 0 10.5 0 0", "")
        instances["windows"] = instances["shutters"]
        instances["railing"] = vectors("-15 0 0 -2.5 0 0 10 0 0 22.5 0 0 35 0 0", "")

        turn["slope"] = "0 0 0.01 0.9999499987499375"
        turn["up"] = "-0.7071067811865476 0 0 0.7071067811865476"
        turn["east"] = "0 0.7071067811865476 0 0.7071067811865476"
        turn["west"] = "0 -0.7071067811865476 0 0.7071067811865476"
        turn["back"] = "0 1 0 0"
        turn["turned"] = "0 -0.19611613513818404 0 0.9805806756909201"
        turn["fall"] = "0.31622776601683794 0 0 0.9486832980505138"
        turn["rise"] = "-0.31622776601683794 0 0 0.9486832980505138"
        turn["look"] = "-0.1478471048258852 -0.22269734714993414 -0.034190026264881407 0.96300475973433908"

        material("asphalt", "0.45, 0.45, 0.42, 1"); material("grass", "0.35, 0.5, 0.25, 1")
        material("earth", "0.35, 0.25, 0.15, 1"); material("tar", "0.2, 0.2, 0.22, 1")
        material("paint", "0.95, 0.95, 0.9, 1"); material("concrete", "0.6, 0.6, 0.6, 1")
        material("oak", "0.5, 0.3, 0.15, 1"); material("plaster", "0.9, 0.85, 0.75, 1")
        material("glass", "0.7, 0.85, 0.95, 0.4", ", \"alphaMode\": \"BLEND\"")
        material("paper", "0.95, 0.9, 0.6, 1"); material("tin", "0.75, 0.75, 0.8, 1")
        material("slate", "0.3, 0.32, 0.36, 1"); material("silicon", "0.05, 0.08, 0.25, 1")
        material("brick", "0.6, 0.25, 0.2, 1"); material("stone", "0.7, 0.65, 0.6, 1")
        material("steel", "0.5, 0.5, 0.55, 1"); material("wood", "0.55, 0.4, 0.25, 1", ", \"doubleSided\": true")
        material("leaves", "0.15, 0.4, 0.1, 1", ", \"doubleSided\": true")

        n = split(ENVIRON["lifts"], given, "\n")
        for (i = 1; i <= n; i++) if (given[i] != "") {
            which = length_of = given[i]
            sub(/=.*/, "", which); sub(/.*=/, "", length_of)
            lift[which] = length_of
        }
    }

    {
        index_of[$1] = count
        name[count] = $1
        if ($2 == "") roots = roots (roots == "" ? "" : ", ") count
        else children[$2] = children[$2] (children[$2] == "" ? "" : ", ") count
        if ($1 in lift) {
            if ($8 == "") { print "house.sh: " $1 " cannot be lifted" >"/dev/stderr"; failed = 1; exit 1 }
            split($5, place, " "); split($8, outward, " ")
            $5 = sprintf("%.17g %.17g %.17g", place[1] + lift[$1] * outward[1], place[2] + lift[$1] * outward[2],
                place[3] + lift[$1] * outward[3])
            delete lift[$1]
        }
        node = "\"translation\": " triple($5)
        if ($6 != "") node = node ", \"rotation\": " triple(turn[$6])
        if ($7 != "1 1 1") node = node ", \"scale\": " triple($7)
        if ($3 == "camera") node = node ", \"camera\": 0"
        else if ($3 != "") {
            key = $3 " of " $4
            if (!(key in mesh_of)) {
                meshes = join(meshes, "{\"name\": \"" key "\", " shape[$3] ", \"material\": " material_of[$4] "}]}")
                mesh_of[key] = mesh_count++
            }
            node = node ", \"mesh\": " mesh_of[key]
        }
        if ($1 in instances)
            node = node ", \"extensions\": {\"EXT_mesh_gpu_instancing\": {\"attributes\": {\"TRANSLATION\": " \
                instances[$1] "}}}"
        body[count++] = node
    }

    END {
        for (which in lift) { print "house.sh: there is no node " which >"/dev/stderr"; failed = 1 }
        if (failed) exit 1
        for (i = 0; i < count; i++) {
            of = name[i]
            nodes = join(nodes, "{\"name\": \"" of "\", " body[i] \
                (of in children ? ", \"children\": [" children[of] "]" : "") "}")
        }
        size = bytes
        while (holds) byte(0)
        print "{\"asset\": {\"version\": \"2.0\"},"
        extension = ": [\"EXT_mesh_gpu_instancing\"],"
        print "\"extensionsUsed\"" extension "\n\"extensionsRequired\"" extension
        printf "%s", "\"scene\": 0, \"scenes\": [{\"name\": \"house\", \"nodes\": [" roots "]}]"
        printf "%s", list("nodes", nodes) list("meshes", meshes) list("materials", materials)
        printf "%s", ",\n\"cameras\": [{\"name\": \"lens\", \"type\": \"perspective\", \"perspective\": " \
            "{\"yfov\": 0.36, \"znear\": 0.05, \"zfar\": 1000}}]"
        printf "%s", list("accessors", accessors) list("bufferViews", views)
        print ",\n\"buffers\": [{\"byteLength\": " size ","
        print "  \"uri\": \"data:application/octet-stream;base64," buffer "\"}]}"
    }'
