#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The probe on the drivers that are here, against what is known of each; a loader that is damaged, hangs or is not there;
# the table of its shader. `make check-probe` installs a driver first. DEPTHPREC_FULL draws more of each driver.
. tests/tap.sh

# name | a file of Debian's that has it | what chooses it | arguments | the
# driver that was recorded | arithmetic | rasterizer | edges | vertices of the plane | conversion
drivers='
lavapipe    | /usr/share/vulkan/icd.d/lvp_icd*.json     | VK_ICD_FILENAMES=@ | --device LLVMPIPE | Mesa 22.3.6 | mesa | lavapipe | edges on 1/256 | unsnapped | to nearest even
swiftshader | /usr/lib/chromium/vk_swiftshader_icd.json | VK_ICD_FILENAMES=@ |             | 5.0.0       | mesa | swiftshader | edges on 1/16 | on 1/16 pixel | to nearest even
llvmpipe    | /usr/lib/*/libEGL_mesa.so.0               | GALLIUM_DRIVER=llvmpipe | --device gl | Mesa 22.3.6 | mesa | llvmpipe | edges on 1/256 | unsnapped | to nearest even
softpipe    | /usr/lib/*/libEGL_mesa.so.0               | GALLIUM_DRIVER=softpipe | --device gl | Mesa 22.3.6 | softpipe | softpipe | unsnapped edges | unsnapped | truncated
'

probe() { # probe ARGUMENTS...: of the driver at hand
    env LIBGL_ALWAYS_SOFTWARE=1 "$chosen" "$DEPTHPREC" probe $arguments "$@"
}

found() { # found FILE: draws, and writes the profile
    probe --json -o "$1"
}

# Every hypothesis is decided but the two that truncate to 24 bits, which are one function; the counts of hits are whole,
# of what is measured half of the pixels (log2 on either side of 2) or all, and no hits; and the second scene was
# predicted to the last pixel.
decided() {
    jq -e '[.findings[] | select(.sure == "no row" or (.sure == "open" and .key + .format != "roundingd24"))] == [] and
           ([.findings[] | select(.sure == "sure") | .cases == .hits] | all) and
           ([.findings[] | select(.sure == "measured") | [.key, .cases, .hits]] ==
            [["log2", 32768, null], ["log2", 32768, null], ["quotient", 65536, null]]) and
           ([.findings[] | select(.key == "prediction") | .cases == 65536 and .hits == 65536] | length >= 2 and all)' "$1"
}

known() { # known FILE ARITH RASTER COVERAGE PLANE CONVERSION
    jq -e --arg arith "$2" --arg raster "$3" --arg coverage "$4" --arg plane "$5" --arg conversion "$6" '
        .arith == $arith and .raster == $raster and
        ([.findings[] | select(.key == "coverage") | .found | contains($coverage)] == [true]) and
        ([.findings[] | select(.key == "plane") | .found | contains($plane)] == [true]) and
        ([.findings[] | select(.key == "rounding") | .found | endswith($conversion)] | length >= 1 and all) and
        ([.findings[] | select(.key == "division") | .found | contains("rounded 1 / w")] == [true]) and
        ([.findings[] | select(.key == "clipping") | .found | contains("0 <= z <= w, exactly")] == [true])' "$1"
}

as_kept() { # as_kept FILE PROFILE: the findings of the profile in the tree
    for f in "$1" "$2"; do jq -S '[.arith, .raster, .subpixel_reported, .findings]' "$f" >"$scratch/findings.${f##*/}"; done
    diff "$scratch/findings.${1##*/}" "$scratch/findings.${2##*/}"
}

# Vulkan's clip z is from 0 to w, and OpenGL's was made so.
says() {
    probe >"$scratch/said" && tr -s ' \n' '  ' <"$scratch/said" | grep -q 'Not measured: clip z from -w,'
}

seeds() { # another scene is predicted as well
    probe --json --seed 7 -o "$scratch/seeded.json" && decided "$scratch/seeded.json"
}

# Every pixel of every shot; and the seed is 0 where none is given.
keeps() { # keeps PROFILE
    probe --json --seed 0 -o "$scratch/zero.json" --keep "$scratch/codes.csv" && cmp "$scratch/zero.json" "$1" || return
    awk -F, 'NR > 1 { shots[$1 "," $2]++ } END { for (s in shots) if (shots[s] != 65536) exit 1; exit !length(shots) }' \
        "$scratch/codes.csv"
}

while IFS='|' read -r driver files chosen arguments version arith raster coverage plane conversion; do
    driver=$(echo $driver) chosen=$(echo $chosen) arguments=$(echo $arguments) version=$(echo $version)
    arith=$(echo $arith) raster=$(echo $raster) coverage=$(echo $coverage) plane=$(echo $plane)
    conversion=$(echo $conversion) made=$scratch/$driver.json
    [ -n "$driver" ] || continue
    file=$(ls $files 2>/dev/null | head -n 1)
    [ "$driver" != swiftshader ] || file=${SWIFTSHADER_ICD:-$file}
    case $chosen in *@) chosen=${chosen%@}$file ;; esac
    if [ -z "$file" ]; then
        skip "$driver is found as it was recorded" "its driver is not here"
    elif ! grep -q ' fma ' /proc/cpuinfo 2>/dev/null; then
        skip "$driver is found as it was recorded" "recorded on a processor with FMA, which this one has not"
    elif ! found "$made" 2>"$scratch/why"; then
        case $(cat "$scratch/why") in
        *"this build has no"*) skip "$driver is found as it was recorded" "$(cat "$scratch/why")" ;;
        *) check "$driver draws" found "$made" ;;
        esac
    elif ! jq -r .device.driver "$made" | grep -qF "$version"; then
        skip "$driver is found as it was recorded" "its driver is $(jq -r .device.driver "$made")"
    else
        check "$driver: every finding is decided, a random scene predicted to the last pixel" decided "$made"
        check "$driver is found as it was recorded" known "$made" "$arith" "$raster" "$coverage" "$plane" "$conversion"
        check "$driver: the profile in the tree" as_kept "$made" "tests/profiles/$driver.json"
        check "$driver: what is not measured is the other clip z" says
        [ -n "${DEPTHPREC_FULL-}" ] || continue
        check "$driver: another scene" seeds
        check "$driver: raw codes, the same again" keeps "$made"
    fi
done <<END
$drivers
END

# ---- Profiles ----------------------------------------------------------------------------------------------------

# What is promised with a profile is what is promised with its rows, and says of which GPU.
promises() {
    raster=$(jq -r '.raster // empty' "$1")
    camera="-n 0.1 -f 1000 -F d32f -m d3d ${raster:+--viewport 1920x1080}"
    "$DEPTHPREC" table $camera --model float --arith "$1" ${raster:+--raster "$1"} >"$scratch/by_profile" || return
    "$DEPTHPREC" table $camera --model float --arith "$(jq -r .arith "$1")" ${raster:+--raster "$raster"} >"$scratch/by_name"
    head -n "$(wc -l <"$scratch/by_name")" "$scratch/by_profile" | diff - "$scratch/by_name" || return
    tail -n +"$(($(wc -l <"$scratch/by_name") + 1))" "$scratch/by_profile" | tr '\n' ' ' | tr -s ' ' >"$scratch/told"
    grep -qF "Measured on $(jq -r .device.name "$1"), driver $(jq -r .device.driver "$1")." "$scratch/told" &&
        "$DEPTHPREC" table $camera --arith "$1" --json | jq -e --slurpfile p "$1" \
            '.measured == "\($p[0].device.name), driver \($p[0].device.driver)"'
}
for profile in tests/profiles/*.json; do
    check "${profile##*/}: promises with it are those of its rows, and name the GPU" promises "$profile"
done

refuses() { # refuses WORDS ARGUMENTS...
    words=$1
    shift
    "$DEPTHPREC" "$@" >"$scratch/out" 2>"$scratch/said"
    status=$?
    cat "$scratch/said"
    [ "$status" -eq "${expected:-2}" ] && { [ ! -s "$scratch/out" ] || grep -q '"error":{' "$scratch/out"; } && [ "$(wc -l <"$scratch/said")" -eq 1 ] &&
        grep -qF -- "$words" "$scratch/said"
}
jq '.raster = null' tests/profiles/swiftshader.json >"$scratch/unknown.json"
jq '.arith = "made-up"' tests/profiles/swiftshader.json >"$scratch/strange.json"
jq '.device.name = "a\nb\u001b[31m"' tests/profiles/swiftshader.json >"$scratch/rude.json"
jq '.findings = []' tests/profiles/swiftshader.json >"$scratch/bare.json"
echo '{"command":"table"}' >"$scratch/other.json"
# SwiftShader has no 24 bits: nothing is promised for them, whoever names them, and nothing else is left out.
stored() { # stored COMMAND...: the formats of the set-ups with its profile
    "$DEPTHPREC" "$@" --raster tests/profiles/swiftshader.json --json | jq -r '[.. | .format? // empty] | unique | join(" ")'
}
lacking='--format: must be fp32 or unorm16 with a profile of a GPU that stores no other depth, got unorm24'
for command in "table -F d24" "table -F d16,d24" "table -F depth24plus" "table --preset three" "table --preset unity,three" \
    "budget -F d24" "zfight -F d24 --separation 1" "bias -F d24 --viewport 9x9" "solve -F d24 --separation 1 --at 5" "plot budget -F d24" \
    "scene tests/models/house.gltf -F d24" "shadow --light-box 40x40x100 -F d24 --api d3d11" \
    "world --from-origin 1e5 -F d24 --at 9"; do
    case $command in
    bias* | shadow*) option=--raster ;;
    *) option=--arith ;;
    esac
    check "a format that the GPU has not: $command" refuses "$lacking" $command $option tests/profiles/swiftshader.json
done
check "who chose the format is said" refuses "$lacking; --preset three chose it" table --preset three --arith tests/profiles/swiftshader.json
only() { [ "$(stored "$@" --viewport 9x9)" = "fp32 unorm16" ]; }
check "formats that nobody named are those of the GPU" only table
check "so are all of them" only table -F all
check "a profile without a format" refuses "must be nothing with a profile" table --arith "$scratch/bare.json"
check "a GPU without a row" refuses "no row predicts" table --viewport 9x9 --raster "$scratch/unknown.json"
check "a row that is not known" refuses "'made-up'" table --arith "$scratch/strange.json"
check "JSON of another command" refuses "must be a profile" table --arith "$scratch/other.json"
check "no JSON" refuses "cannot be read" table --arith README.md
missing() { (expected=3 && refuses "$@"); }
check "no file" missing "none.json: No such file or directory" table --arith "$scratch/none.json"
check "control characters of a driver are not printed" sh -c \
    '! "$1" table -F d32f --arith "$2" | grep -q "$(printf "\033")"' - "$DEPTHPREC" "$scratch/rude.json"

# ---- Loaders that are none ---------------------------------------------------------------------------------------

fake() { # fake NAME CODE: a folder with a libvulkan.so.1
    mkdir -p "$scratch/$1" && printf '%s\n' "$2" >"$scratch/$1/fake.c" &&
        ${CC:-cc} -shared -fPIC -w -o "$scratch/$1/libvulkan.so.1" "$scratch/$1/fake.c"
}
under() { # under NAME WORDS
    expected=3
    export LD_LIBRARY_PATH="$scratch/$1"
    refuses "$2" probe
    result=$?
    unset LD_LIBRARY_PATH expected
    return $result
}
mkdir "$scratch/damaged" && echo "no library" >"$scratch/damaged/libvulkan.so.1"
fake empty 'int nothing;' && fake crash '#include <stdlib.h>
__attribute__((constructor)) static void start(void) { abort(); }' && fake leaves '#include <unistd.h>
__attribute__((constructor)) static void start(void) { _exit(0); }' && fake hang '#include <unistd.h>
__attribute__((constructor)) static void start(void) { for (;;) pause(); }'
if "$DEPTHPREC" probe 2>&1 | grep -q "this build has no Vulkan"; then
    skip "loaders that are none" "built without Vulkan's headers"
else
    check "no loader: the package is named" under damaged "Debian's package libvulkan1"
    check "a loader without functions" under empty "Debian's package libvulkan1"
    check "a driver that breaks down" under crash "the driver broke down"
    check "a driver that ends early" under leaves "damaged"
    if [ -n "${DEPTHPREC_FULL-}" ]; then
        check "a driver that hangs" under hang "does not come to an end in 60 s"
    else
        skip "a driver that hangs" "takes a minute: in make check-full"
    fi
fi

# ---- A device that fails -----------------------------------------------------------------------------------------

# A driver that is lavapipe but for one function, which gives its result without doing anything; and which says so.
failing() { # failing FUNCTION RESULT: the file that chooses it
    cat >"$scratch/$1.c" <<'C'
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
typedef void (*any)(void);
typedef any (*finder)(void *, const char *);
static void *driver(void) {
    static void *handle;
    return handle = handle ? handle : dlopen(DRIVER, RTLD_NOW | RTLD_LOCAL);
}
static int fails(void) { return RESULT; }
static any choose(void *of, const char *name, const char *by);
static any of_device(void *device, const char *name) { return choose(device, name, NULL); }
static finder devices;
static any choose(void *of, const char *name, const char *by) {
    if (strcmp(name, FUNCTION) == 0) return (any)fails;
    any found = by ? ((finder)dlsym(driver(), by))(of, name) : devices(of, name);
    if (strcmp(name, "vkGetDeviceProcAddr") == 0 && found) return devices = (finder)found, (any)of_device;
    return found;
}
any vk_icdGetInstanceProcAddr(void *of, const char *name) { return choose(of, name, "vk_icdGetInstanceProcAddr"); }
any vk_icdGetPhysicalDeviceProcAddr(void *of, const char *name) { return choose(of, name, "vk_icdGetPhysicalDeviceProcAddr"); }
int vk_icdNegotiateLoaderICDInterfaceVersion(unsigned *version) {
    puts("a driver's words"), fflush(stdout);
    return ((int (*)(unsigned *))dlsym(driver(), "vk_icdNegotiateLoaderICDInterfaceVersion"))(version);
}
C
    ${CC:-cc} -shared -fPIC -w -DDRIVER="\"$lavapipe\"" -DFUNCTION="\"$1\"" -DRESULT="$2" -o "$scratch/$1.so" \
        "$scratch/$1.c" -ldl &&
        echo "{\"file_format_version\":\"1.0.0\",\"ICD\":{\"library_path\":\"$scratch/$1.so\",\"api_version\":\"1.3.0\"}}" \
            >"$scratch/$1.json"
}
when() { # when FUNCTION RESULT WORDS
    failing "$1" "$2" && (expected=3 && export VK_ICD_FILENAMES="$scratch/$1.json" && refuses "$3" probe --json)
}
unharmed() { # the same driver, of which no function fails
    failing vkNoFunction 0 && VK_ICD_FILENAMES="$scratch/vkNoFunction.json" "$DEPTHPREC" probe --json >"$scratch/whole" &&
        jq -e '.raster == "lavapipe"' "$scratch/whole"
}
lavapipe=$(ls /usr/lib/*/libvulkan_lvp.so 2>/dev/null | head -n 1)
if [ -z "$lavapipe" ] || "$DEPTHPREC" probe 2>&1 | grep -q "this build has no Vulkan"; then
    skip "devices that fail" "lavapipe or Vulkan's headers are not here"
else
    check "what a driver prints is not among what is printed" unharmed
    check "a device that is lost" when vkWaitForFences -4 "the device was lost"
    check "a draw that does not end" when vkWaitForFences 2 "the device does not come to an end"
    check "a device that is lost before a draw" when vkQueueSubmit -4 "the device was lost"
    check "a device without memory" when vkAllocateMemory -2 "the device has no memory for it"
    check "a machine without memory" when vkCreateGraphicsPipelines -1 "there is no memory for it"
    check "a device that does not begin" when vkCreateDevice -3 "the driver refuses"
fi

# ---- The shader --------------------------------------------------------------------------------------------------

generated() {
    sh src/probe/spirv.sh >"$scratch/spirv.h" && diff src/probe/spirv.h "$scratch/spirv.h"
}
if ! command -v glslangValidator >/dev/null 2>&1; then
    skip "the table of the shader is made from its source" "glslangValidator is not here"
elif ! glslangValidator --version | grep -q '^Glslang Version: 11:12'; then
    skip "the table of the shader is made from its source" "made by another version of glslang"
else
    check "the table of the shader is made from its source" generated
fi
finish
