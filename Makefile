# SPDX-License-Identifier: GPL-3.0-or-later
# depthprec: `make demo` shows it, `make help` lists the rest.
define another_make
.error this is not GNU make: on this system it is called gmake
endef

CONF ?= release                 # release, asan, coverage or fuzz; each has a build folder of its own
CONF := $(strip $(CONF))
B := $(if $(filter release,$(CONF)),build,build/$(CONF))

prefix ?= $(or $(PREFIX),/usr/local)
exec_prefix ?= $(prefix)
bindir ?= $(exec_prefix)/bin
libdir ?= $(exec_prefix)/lib
includedir ?= $(prefix)/include
datarootdir ?= $(prefix)/share
mandir ?= $(datarootdir)/man
docdir ?= $(datarootdir)/doc/depthprec
INSTALL ?= install
INSTALL_PROGRAM ?= $(INSTALL) -m 755
INSTALL_DATA ?= $(INSTALL) -m 644

# What pkg-config is asked for: by the full program, and by the tests. src/packages.sh knows who has them.
PKGS_build := cairo gsl jansson libpng zlib
# Whose headers are used where they are there, as those of libtiff are; the libraries are opened when a file needs them.
PKGS_opened := OpenEXR assimp vulkan egl gl
PKGS_check := cmocka mpfr gmp jansson libxml-2.0 cairo

VERSION := $(shell sed -n 's/^.define DP_VERSION *"\(.*\)"/\1/p' include/depthprec/depthprec.h)

# ---- Rooms: a new file in a layer's folder is picked up ----------------------------------------------------------

HEADERS := $(wildcard include/depthprec/*.h)
CORE := $(wildcard src/core/*.c)
PAGE := $(wildcard src/web/*.c src/npm/*.c)
WINDOWS := $(wildcard src/windows/*.c)
ROOMS := $(filter-out $(CORE) $(PAGE) $(WINDOWS),$(wildcard src/*/*.c src/*/*/*.c))
TESTS := $(wildcard tests/*/test_*.c)
BENCHES := $(wildcard tests/bench_*.c)
FUZZ := $(wildcard tests/fuzz/fuzz_*.c)
WEB := $(filter-out $(TESTS),$(wildcard tests/web/*.c tests/python/*.c tests/npm/*.c))
SUPPORT := $(filter-out $(TESTS) $(BENCHES) $(FUZZ) $(WEB),$(wildcard tests/*.c tests/*/*.c))
MAN := $(patsubst %,$(B)/%,$(wildcard man/*.[1-9]))
TOOLS := tests/run.sh tests/tap.sh tests/coverage.sh tests/cross.sh tests/linked.sh tests/page.sh tests/docs.sh tests/bench.sh tests/windows.sh tests/dist.sh
SCRIPTS := $(wildcard src/*.sh src/windows/*.sh tests/*.sh tests/models/*.sh plots/*.sh man/*.sh .ci/*.sh)
ALL_C := $(CORE) $(ROOMS) $(PAGE) $(WINDOWS) $(TESTS) $(BENCHES) $(SUPPORT) $(FUZZ) $(WEB)
ALL_H := $(HEADERS) $(wildcard src/*/*.h src/*/*/*.h tests/*.h tests/*/*.h)

objects = $(patsubst %.c,$(B)/obj/%.o,$(1))
CORE_O := $(call objects,$(CORE))
ROOMS_O := $(call objects,$(ROOMS))
TESTS_O := $(call objects,$(TESTS) $(BENCHES))
SUPPORT_O := $(call objects,$(SUPPORT))
FUZZ_O := $(call objects,$(FUZZ))
TEST_PROGRAMS := $(patsubst %.c,$(B)/tests/%,$(notdir $(TESTS)))
BENCH_PROGRAMS := $(patsubst tests/%.c,$(B)/tests/%,$(BENCHES))
FUZZ_PROGRAMS := $(patsubst tests/fuzz/%.c,$(B)/%,$(FUZZ))

# ---- Flags: CC, CFLAGS, CPPFLAGS and LDFLAGS are the user's; what correctness needs stands apart ------------------

CFLAGS ?= $(or $(OPTIMIZE_$(CONF)),-O1 -g)
OPTIMIZE_release := -O3
# Sanitizers print lines: of what a debugger knows no more is made.
OPTIMIZE_asan := -O2 -g1
# A test program is compiled more often than it runs long; what tests compute for long stands in their other files.
CFLAGS_TESTS := $(if $(filter file,$(origin CFLAGS)),-O1 $(filter -g%,$(CFLAGS)),$(CFLAGS))

SANITIZE := address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
# No loop with sanitizers in it becomes vectors. That they are there gcc says by this macro, clang by another word. Of
# what three checks of pointers refuse, the address sanitizer refuses most once it is read: they are `make fuzz`'s, for two
# fifths of the time of compiling went into them.
MODE_asan := -fsanitize=$(SANITIZE) -fno-sanitize=null,object-size,pointer-overflow -Wno-pass-failed -D__SANITIZE_ADDRESS__=1
# Exceptions within libraries that are opened later need it there from the start.
LINK_asan := $(if $(shell command -v ld.lld),-fuse-ld=lld) -Wl,--no-as-needed -lstdc++
MODE_coverage := --coverage
MODE_fuzz := -fsanitize=fuzzer-no-link,$(SANITIZE)
MODE := $(MODE_$(CONF))
# Of another compiler than the release, whose sanitizers know more: its warnings and its results are judged, too.
ifneq ($(filter asan-default fuzz-default,$(CONF)-$(origin CC)),)
CC := clang
endif

# WERROR=-Werror is for .ci/run: another compiler's warnings stop nobody who builds. clang takes every INFINITY and NAN
# for a promoted float; gcc, which does not, judges promotions alone.
WARN := -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Wstrict-prototypes $(WERROR)
WARN_clang := $(WARN) -Wno-double-promotion
# Without traps and errno loops with a choice become vectors; no result changes. Nor may contraction change one.
EXACT := -fno-math-errno -fno-trapping-math -ffp-contract=off -fopenmp-simd
INCLUDES := -Iinclude -Isrc -Itests
COMPILE = $(CC) -std=gnu11 $(INCLUDES) $(CPPFLAGS) $(if $(findstring clang,$(CC)),$(WARN_clang),$(WARN)) $(CFLAGS) $(MODE) $(EXACT) -fvisibility=hidden -fPIC -MMD -MP
LINK = $(CC) $(CFLAGS) $(MODE) $(LDFLAGS) $(LINK_$(CONF)) -Wl,--as-needed

Q := $(if $(filter 1,$(V)),,@)
comma := ,
say = @$(if $(Q),printf '  %-7s %s\n' $(1) $@,:)
JOBS ?= $(shell nproc 2>/dev/null || echo 1)
PARALLEL = --no-print-directory --output-sync=target $(if $(findstring -j,$(MAKEFLAGS)),,-j$(JOBS))

# ---- Build -------------------------------------------------------------------------------------------------------

.DELETE_ON_ERROR:
.PHONY: all lib programs man demo packages
all: programs lib # in this order: without the libraries make says so before it compiles
lib: $(B)/libdepthprec.a $(B)/libdepthprec.so.0
programs: $(B)/depthprec

DEMO_CAMERA := --near 0.1 --far 1000 --format all --mapping d3d,reversed
DEMO_FIGURES := $(foreach f,distribution share error interval map,$f.svg $f.png)
demo:
	@sh src/packages.sh build
	@$(MAKE) $(PARALLEL) all
	@$(B)/depthprec table $(DEMO_CAMERA)
	@mkdir -p $(B)/demo
	@for f in $(DEMO_FIGURES); do $(B)/depthprec plot $${f%.*} $(DEMO_CAMERA) -o $(B)/demo/$$f || exit 1; done
	@echo "Figures in $(B)/demo: $(DEMO_FIGURES)"

packages:
	@sh src/packages.sh check

$(B)/obj/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(COMPILE) $(EXTRA) -c -o $@ $<

# The rooms above the core may use the big libraries and threads; the core may not.
$(ROOMS_O): EXTRA = @$(B)/build.cflags
$(ROOMS_O): | $(B)/build.cflags
$(TESTS_O) $(SUPPORT_O): EXTRA = @$(B)/check.cflags
$(call objects,$(TESTS)): CFLAGS := $(CFLAGS_TESTS)
$(TESTS_O) $(SUPPORT_O): | $(B)/check.cflags

# pkg-config is asked when a recipe runs, because it may have been installed a moment ago. Not every clang has OpenMP.
$(B)/build.cflags $(B)/check.cflags: $(B)/%.cflags: Makefile
	@mkdir -p $(@D)
	@pkg-config --cflags $(PKGS_$*) 2>/dev/null >$@ || \
	    { sh src/packages.sh --missing $* && pkg-config --print-errors --exists $(PKGS_$*); exit 1; }
	@for p in $(PKGS_opened); do ! pkg-config --exists $$p || pkg-config --cflags-only-I $$p >>$@; done
	@echo 'int main(void) { return 0; }' | $(CC) -fopenmp -x c -o $@.probe - 2>/dev/null && echo -fopenmp >>$@; rm -f $@.probe
	@echo -pthread >>$@
$(B)/build.libs $(B)/check.libs: $(B)/%.libs: $(B)/%.cflags
	@pkg-config --libs $(PKGS_$*) >$@ && echo -ldl >>$@ && sed -n '/^-fopenmp/p;/^-pthread/p' $< >>$@

$(B)/libdepthprec.a: $(CORE_O)
$(B)/librooms.a: $(filter-out %/main.o,$(ROOMS_O))
$(B)/libsupport.a: $(SUPPORT_O)
$(B)/%.a:
	@mkdir -p $(@D)
	$(call say,AR)
	$(Q)rm -f $@ && $(AR) rcs $@ $^

$(B)/libdepthprec.so.0: $(CORE_O)
	$(call say,LD)
	$(Q)$(LINK) -shared -Wl,-soname,$(@F) -o $@ $^ -lm

# What the program says of itself stands in its pages.
man: $(MAN)
$(B)/man/%: man/% man/fill.sh $(B)/depthprec
	@mkdir -p $(@D)
	$(call say,MAN)
	$(Q)sh man/fill.sh $(B)/depthprec $< >$@

$(B)/depthprec: $(ROOMS_O) $(B)/libdepthprec.a | $(B)/build.libs
	$(call say,LD)
	$(Q)$(LINK) -o $@ $^ @$(B)/build.libs -lm

# All pages as HTML, with the page of the program.
.PHONY: docs
docs:
	@sh src/packages.sh docs
	@$(MAKE) $(PARALLEL) programs man web
	@printf '  %-7s %s\n' DOCS $(B)/docs
	$(Q)python3 -B man/docs.py $(B) $(B)/docs

# ---- For Python --------------------------------------------------------------------------------------------------

# A wheel is a zip that python3 alone writes. The program in it needs the C library and nothing else: it draws as the page
# does, without cairo, and of the other libraries it has the static ones.
.PHONY: wheel wheel-parts
wheel:
	@sh src/packages.sh build
	@$(MAKE) $(PARALLEL) wheel-parts
	$(Q)B='$(B)' python3 src/python/package.py $(B)/dist

wheel-parts: $(B)/libdepthprec.so.0 $(B)/plain/depthprec

PLAIN_O := $(filter-out %/draw/canvas.o,$(ROOMS_O)) $(call objects,src/web/canvas.c src/web/plain.c)
PLAIN_LIBS := -lgsl -lgslcblas -ljansson -lpng16 -lz $(if $(findstring clang,$(CC)),,-lgomp)
$(B)/plain/depthprec: $(PLAIN_O) $(B)/libdepthprec.a
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(LINK) -s -o $@ $^ -Wl,-Bstatic $(PLAIN_LIBS) -Wl,-Bdynamic -ldl -pthread -lm

# ---- For Windows -------------------------------------------------------------------------------------------------

# The program of a wheel, by mingw-w64, and the library. Windows keeps the stack aligned to 16 bytes, so that no vector of
# 32 may be moved there as if it were aligned. What a format may hold is judged where the others are built.
.PHONY: windows
windows:
	@$(if $(MSYSTEM),,sh src/packages.sh windows)
	@$(MAKE) $(PARALLEL) $(B)/windows/depthprec.exe $(B)/windows/depthprec.dll

MINGW ?= x86_64-w64-mingw32
WINDOWS_CC ?= $(MINGW)-gcc-posix
WINDRES ?= $(MINGW)-windres
WINDOWS_ROOT := $(B)/windows/root
WINDOWS_LIBRARIES := $(WINDOWS_ROOT)/lib/libwindows.a
WINDOWS_FLAGS := -Wall -Wextra -Wno-format -Wno-format-extra-args $(OPTIMIZE_release) $(EXACT) -fopenmp \
    -Wa,-muse-unaligned-vector-move -D__USE_MINGW_ANSI_STDIO=1 -D_FILE_OFFSET_BITS=64
WINDOWS_LINK = $(WINDOWS_CC) -s -static -fopenmp -Wl,--no-insert-timestamp,--stack,8388608
WINDOWS_CANVAS := src/web/canvas.c src/web/plain.c
WINDOWS_HEADERS := -isystem $(WINDOWS_ROOT)/include
# In a shell of MSYS2 it is the whole program, with the libraries there.
ifdef MSYSTEM
WINDOWS_CC := gcc
WINDRES := windres
WINDOWS_LIBRARIES :=
WINDOWS_LINK = gcc -s -fopenmp -Wl,--stack,8388608
WINDOWS_CANVAS := src/draw/canvas.c
WINDOWS_HEADERS = $(shell pkg-config --cflags $(PKGS_build))
WINDOWS_DYNAMIC = $(shell pkg-config --libs $(PKGS_build))
endif
windows_objects = $(patsubst %.c,$(B)/windows/obj/%.o,$(1))
WINDOWS_CORE_O := $(call windows_objects,$(CORE) src/windows/fma.c)
WINDOWS_O := $(call windows_objects,$(filter-out src/draw/canvas.c src/system/pager.c src/system/sandbox.c,$(ROOMS)) $(WINDOWS_CANVAS) \
    src/windows/posix.c)

$(WINDOWS_ROOT)/lib/libwindows.a: src/windows/libraries.sh
	$(call say,GET)
	$(Q)sh $< '$(WINDOWS_CC)' $(MINGW)-ar $(WINDOWS_ROOT)

$(B)/windows/obj/%.o: %.c Makefile | $(WINDOWS_LIBRARIES)
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(WINDOWS_CC) -std=gnu11 $(INCLUDES) $(WINDOWS_FLAGS) $(WINDOWS_HEADERS) -MMD -MP -c -o $@ $<

# The page has these, too, and no header of a system.
$(call windows_objects,src/web/canvas.c src/report/output.c src/method/cmd_methods/methods.c): WINDOWS_FLAGS += -include system/posix.h

$(B)/windows/manifest.o: src/windows/depthprec.manifest
	@mkdir -p $(@D)
	$(Q)echo '1 24 "$<"' | $(WINDRES) -o $@

$(B)/windows/depthprec.exe: $(WINDOWS_O) $(WINDOWS_CORE_O) $(B)/windows/manifest.o $(WINDOWS_LIBRARIES)
	$(call say,LD)
	$(Q)$(WINDOWS_LINK) -o $@ $^ $(WINDOWS_DYNAMIC)

# With its import library, which linkers of both kinds read, and what it exports.
$(B)/windows/depthprec.dll: $(WINDOWS_CORE_O) $(HEADERS)
	$(call say,LD)
	$(Q){ echo EXPORTS; sed -n 's/^DP_API.*[ *]\(dp_[a-z0-9_]*\)(.*/\1/p' $(HEADERS); } >$(@:dll=def)
	$(Q)$(WINDOWS_LINK) -shared -o $@ $(WINDOWS_CORE_O) $(@:dll=def) -Wl,--out-implib,$(@:dll=lib)

# ---- For the web -------------------------------------------------------------------------------------------------

# The program as WebAssembly, for the page: the same files, with the same bits; src/web stands in for what needs files,
# threads, cairo, GSL or jansson. And the core alone: `samples` prints its bits, here and there (tests/web.sh).
.PHONY: web
web:
	@sh src/packages.sh web
	@$(MAKE) $(PARALLEL) $(B)/web/core.wasm $(B)/depthprec.html

# Rooms that the page lacks but for these files and the options of their commands; and files of others that it lacks.
WEB_LESS := convert method model scene shader shadow system texture
WEB_FROM := method/bound method/bound_linearize method/choose method/encode method/estimate method/families method/interval method/limit \
    method/linearize method/method method/steps method/term method/truth method/ways shader/camera shader/constants shader/decode shader/oblique shader/packing shader/position system/pages \
    shader/sample_rounding texture/device texture/metric texture/moved texture/recognise texture/sensor texture/sensor_buffer \
    texture/sensor_choice texture/sensor_levels texture/sensor_find texture/sensor_fit texture/sensor_sample texture/sensor_surface texture/stereo texture/units \
    $(patsubst %,texture/cmd_texture/%,camera file lattice matrix products reading source)
WEB_NOT := bias/drawn bias/cmd_bias/trial cli/words cli/questions solve/cmd_solve/preset world/cmd_world/options image/channel image/dds image/exr image/png image/ros image/tiff \
    camera/depth_range camera/figure_cost camera/profile_file camera/upscaler camera/cmd/depth_range camera/cmd/profile cli/link cli/stop cli/cmd_help/completions cli/cmd_help/help cli/cmd_list/command cli/cmd_list/options draw/canvas draw/pixels \
    judge/given judge/listing judge/read_pairs judge/written judge/cmd_judge/shader probe/compile probe/opengl probe/probe probe/vulkan \
    probe/vulkan_compute probe/vulkan_draw quantity/cmd/preset_run quantity/cmd_table/constants quantity/cmd_table/in_preset quantity/cmd_table/levels quantity/cmd_table/slices report/output_file report/terminal solve/figure_needs \
    raster/resolve web/plain world/arithmetic world/figure world/cmd_world/command zfight/figure zfight/cmd_prepass/stored zfight/cmd_prepass/stored_options
WEB_SOURCES := $(sort $(filter-out $(patsubst %,src/%.c,$(patsubst %,%/%,$(WEB_LESS)) $(WEB_NOT)),$(CORE) $(ROOMS) $(wildcard src/web/*.c)) \
    $(wildcard $(patsubst %,src/*/cmd_%/options.c,bias budget judge plot prepass probe solve table texture zfight)) $(patsubst %,src/%.c,$(WEB_FROM)))

WEB_CC ?= clang --target=wasm32-wasi
# Instructions that browsers and node have since 2020; there is one thread, and what belongs to it is the program's.
WEB_FLAGS := $(WARN_clang) -Wno-shorten-64-to-32 $(EXACT) -Wno-pass-failed -fvisibility=hidden -ffunction-sections -fdata-sections \
    -mbulk-memory -msign-ext -mnontrapping-fptoint -D_Thread_local=
# The lowest KiB is the far end of the stack: nothing else has an address there. Large functions that are called once stay
# apart: packed, the module is smaller so.
WASM_OPT := -Oz --converge --one-caller-inline-max-function-size=20 --enable-bulk-memory --enable-sign-ext --enable-nontrapping-float-to-int --enable-mutable-globals \
    --low-memory-unused --strip-producers --strip-target-features
# The stack below all else: what overflows it ends, and overwrites nothing.
WEB_LINK = $(WEB_CC) -mexec-model=reactor -Wl,--gc-sections,--stack-first,-z,stack-size=1048576 -s
web_objects = $(patsubst %.c,$(B)/web/obj/%.o,$(1))
WEB_CORE_O := $(call web_objects,$(CORE))
WEB_O := $(call web_objects,$(WEB_SOURCES))
WEB_DRAW_O := $(call web_objects,$(filter-out %/fight.c %/mesh.c %/vertex_compare.c %/vertex_program.c,$(wildcard src/raster/*.c)))
SAMPLES_O := $(foreach p,samples frames,$(B)/web/obj/tests/web/$p.o $(B)/obj/tests/web/$p.o)
# Fast where numbers are made, small elsewhere.
$(call web_objects,$(patsubst %,src/core/%.c,batch batch_baseline boundary depth elementary expansion pipeline separation \
    separation_over windows) $(patsubst %,src/raster/%.c,clip draw mesa picture pixels raster snapped swiftshader) src/texture/moved.c src/web/kinds.c): WEB_OPTIMIZE := -O2
$(B)/web/obj/%.o: WEB_OPTIMIZE ?= -Oz
$(B)/web/obj/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(call say,WEB)
	$(Q)$(WEB_CC) -std=gnu11 $(INCLUDES) $(WEB_OPTIMIZE) $(WEB_FLAGS) -MMD -MP -c -o $@ $<

$(B)/web/depthprec.wasm: $(WEB_O)
	$(call say,WEB)
	$(Q)$(WEB_LINK) -o $@.all $^
	$(Q)wasm-opt $(WASM_OPT) -o $@ $@.all && rm $@.all

# One file: no import works from file://, and no static host has to know WebAssembly.
$(B)/depthprec.html: $(B)/web/depthprec.wasm $(wildcard src/web/*.html src/web/*.css src/web/*.js src/web/*.mjs)
	$(call say,WEB)
	$(Q)node src/web/bundle.mjs $< $@

$(B)/web/core.wasm: $(WEB_CORE_O)
	$(call say,WEB)
	$(Q)$(WEB_LINK) -Wl,--export-dynamic -o $@ $^

$(B)/web/frames.wasm: $(WEB_DRAW_O)
$(B)/web/samples.wasm $(B)/web/frames.wasm: $(B)/web/%.wasm: $(B)/web/obj/tests/web/%.o $(WEB_CORE_O)
	$(call say,WEB)
	$(Q)$(WEB_CC) -o $@ $^

$(B)/web/frames: $(B)/librooms.a
$(B)/web/samples $(B)/web/frames: $(B)/web/%: $(B)/obj/tests/web/%.o $(B)/libdepthprec.a
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(LINK) -o $@ $(filter %.o,$^) $(filter %rooms.a,$^) $(B)/libdepthprec.a -lm

# ---- For npm -----------------------------------------------------------------------------------------------------

# The library behind a door, which imports nothing; and the whole program but what needs cairo, PNG, JSON, GSL, threads and
# processes, for which src/npm stands in. Written by tar and gzip: names sorted, times fixed.
.PHONY: npm
npm:
	@sh src/packages.sh npm
	@$(MAKE) $(PARALLEL) $(B)/dist/depthprec-$(VERSION).tgz

NPM_NOT := $(patsubst %,src/%.c,draw/canvas draw/pixels image/png method/cmd_methods/command method/cmd_methods/families cli/stop texture/strips \
    probe/opengl probe/vulkan probe/vulkan_compute probe/vulkan_draw probe/compile \
    report/output_file report/terminal system/dynload system/pager system/sandbox)
NPM_O := $(call web_objects,$(filter-out $(NPM_NOT),$(ROOMS)) $(patsubst %,src/web/%.c,canvas engine plain still stream) \
    src/npm/standin.c)
NPM_DOOR_O := $(call web_objects,src/npm/door.c)
NPM_FILES := $(wildcard src/npm/*.js src/npm/*.ts src/npm/*.md) src/web/engine.js src/web/command.js LICENSE LICENSE.MIT \
    LICENSE.GPL-3.0 $(B)/npm/core.data.js $(B)/npm/program.data.js

$(B)/web/obj/src/scene/find.o: WEB_FLAGS += -include npm/standin.h
$(B)/npm/core.wasm: $(NPM_DOOR_O) $(WEB_CORE_O)
$(B)/npm/program.wasm: $(NPM_O) $(WEB_CORE_O)
$(B)/npm/%.wasm:
	@mkdir -p $(@D)
	$(call say,WEB)
	$(Q)$(WEB_LINK) -o $@ $^

# Text, which every bundler takes; the program compressed, because it is read only when it is asked for.
$(B)/npm/core.data.js: PACK := cat
$(B)/npm/program.data.js: PACK := gzip -9n
$(B)/npm/%.data.js: $(B)/npm/%.wasm
	$(Q){ printf 'export default "'; $(PACK) <$< | base64 | tr -d '\n'; echo '";'; } >$@

$(B)/dist/depthprec-$(VERSION).tgz: $(NPM_FILES) src/npm/package.json Makefile
	@mkdir -p $(@D)
	$(call say,PACK)
	$(Q)rm -rf $(B)/npm/package && mkdir $(B)/npm/package && cp $(NPM_FILES) $(B)/npm/package
	$(Q)sed 's/@version@/$(VERSION)/' src/npm/package.json >$(B)/npm/package/package.json
	$(Q)tar -C $(B)/npm --format=ustar --sort=name --mtime=@499162500 --owner=0 --group=0 --numeric-owner \
	    --mode=u=rwX,go=rX -cf - package | gzip -9n >$@

# ---- Tests -------------------------------------------------------------------------------------------------------

.PHONY: cross-windows check-dist check check-full check-programs check-baseline check-probe check-web asan fuzz coverage mutants cross
SHELL_TESTS := $(filter-out $(TOOLS),$(wildcard tests/*.sh))
# In the release alone: of objects, headers, the tests themselves, programs of others and what clang makes for the web no
# sanitizer has a say; of the gallery none that it has not had of the same figures in test_drawn_*; and of the answers
# that test_values_* and these scripts compute anew none that it has not had of the same commands in cli.sh.
ONCE := $(patsubst %,tests/%.sh,layers headers install readme can_fail mutants aims cameras python npm web gappa engines \
    public_models vtk plots examples questions same seeds judge_code fields platform code) $(B)/tests/test_values_%
# The scripts come first, which take longest: at the end no core waits for one of them.
RUN_TESTS = $(filter-out $(if $(filter release,$(CONF)),,$(ONCE)),$(SHELL_TESTS) $(TEST_PROGRAMS))

check:
	@sh src/packages.sh check
	@$(MAKE) $(PARALLEL) all check-programs
	@B=$(B) CC='$(CC)' DEPTHPREC=$(CURDIR)/$(B)/depthprec sh tests/run.sh $(RUN_TESTS)
	@sh src/packages.sh --left web npm docs probe

check-programs: $(TEST_PROGRAMS)

# All cases, the whole of what .ci/run takes a part of, and what it leaves out. `make cross` and `make deb` need Debian.
FULL := check check-web check-probe cross cross-windows check-dist
check-full:
	@failed=; for t in $(FULL); do echo "make $$t"; DEPTHPREC_FULL=1 $(MAKE) --no-print-directory $$t || failed="$$failed $$t"; done; \
	    [ -z "$$failed" ] || { echo "failed: make$$failed" && exit 1; }

asan:
	@sh src/packages.sh fuzz
	@DEPTHPREC_QUICK=1 LSAN_OPTIONS=suppressions=$(CURDIR)/tests/lsan.supp:print_suppressions=0 \
	    $(MAKE) --no-print-directory CONF=asan check

# Without what needs AVX: neither kernels of the library's own, of which src/core/batch.c alone knows, nor the C library's
# functions. The programs whose numbers may come from either, with few cases, and the recorded texts.
WITHOUT_AVX := batch bias_drawn bound census census_asked census_kernel code decode draw draw_fight effect effects_pixels \
    elementary frame frame_errors frame_summary image_depths normal picture position quotient raster raster_any \
    raster_input rasterizers sample_rounding scene_render shadow_drawn staged texture_report triangles triangles_drawn \
    values_texture values_zfight vertex world
BASELINE_PROGRAMS := $(patsubst %,$(B)/baseline/test_%,$(WITHOUT_AVX))
check-baseline:
	@sh src/packages.sh check
	@$(MAKE) $(PARALLEL) $(B)/baseline/depthprec $(BASELINE_PROGRAMS)
	@B=$(B) CC='$(CC)' DEPTHPREC=$(CURDIR)/$(B)/baseline/depthprec DEPTHPREC_QUICK=1 \
	    GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4 sh tests/run.sh $(BASELINE_PROGRAMS) tests/cli.sh

$(B)/baseline/batch.o: src/core/batch.c Makefile
	@mkdir -p $(@D)
	$(call say,CC)
	$(Q)$(COMPILE) -DDP_BASELINE -c -o $@ $<

# It stands before the libraries, and is taken instead of theirs.
$(B)/baseline/depthprec: $(ROOMS_O) $(B)/baseline/batch.o $(B)/libdepthprec.a | $(B)/build.libs
	$(call say,LD)
	$(Q)$(LINK) -o $@ $^ @$(B)/build.libs -lm

# A test is called by its name alone, whatever its room. A % in a rule is replaced before it could be the filter's.
any := %
.SECONDEXPANSION:
$(BASELINE_PROGRAMS): $(B)/baseline/%: $$(filter $$(any)/$$*.o,$$(TESTS_O)) $(B)/baseline/batch.o $(B)/libsupport.a $(B)/librooms.a \
    $(B)/libdepthprec.a | $(B)/check.libs $(B)/build.libs
	$(call say,LD)
	$(Q)$(LINK) -o $@ $^ @$(B)/check.libs @$(B)/build.libs -lm

# The page in a browser, which page.sh installs where it can, and then all pages in it.
check-web: docs
	@B=$(B) CC='$(CC)' DEPTHPREC=$(CURDIR)/$(B)/depthprec TEST_SECONDS=1500 sh tests/run.sh tests/page.sh
	@B=$(B) DEPTHPREC=$(CURDIR)/$(B)/depthprec sh tests/run.sh tests/docs.sh

# A driver without a GPU, and the probe on it.
check-probe:
	@sh src/packages.sh probe
	@$(MAKE) $(PARALLEL) all
	@B=$(B) CC='$(CC)' DEPTHPREC=$(CURDIR)/$(B)/depthprec sh tests/run.sh tests/probe.sh

MACHINES ?= aarch64 s390x
cross:
	@sh src/packages.sh cross
	@[ -z '$(filter windows,$(MACHINES))' ] || sh src/packages.sh wine
	@for m in $(MACHINES); do CC='$(CC)' sh tests/cross.sh $$m || exit 1; done

# A release, twice.
check-dist:
	@CC='$(CC)' TEST_SECONDS=7200 sh tests/run.sh tests/dist.sh

cross-windows:
	@$(MAKE) --no-print-directory cross MACHINES=windows

$(B)/tests/%: $$(filter $$(any)/$$*.o,$$(TESTS_O)) $(B)/libsupport.a $(B)/librooms.a $(B)/libdepthprec.a | $(B)/check.libs $(B)/build.libs
	@mkdir -p $(@D)
	$(call say,LD)
	$(Q)$(LINK) -o $@ $^ @$(B)/check.libs @$(B)/build.libs -lm

# This one counts calls.
$(B)/tests/test_once: LDFLAGS += $(patsubst %,-Wl$(comma)--wrap=dp_%,pipeline_prepare chain_make slant_make log_shader_make)

$(B)/tests/test_windows_fma: $(B)/obj/src/windows/fma.o

mutants:
	@sh src/packages.sh check
	@CC='$(CC)' sh tests/mutants.sh --run

FUZZ_SECONDS ?= 20
ifeq ($(CONF),fuzz)
fuzz: $(FUZZ_PROGRAMS)
	@export LSAN_OPTIONS=suppressions=$(CURDIR)/tests/lsan.supp:print_suppressions=0; \
	for f in $^; do mkdir -p $$f.corpus && echo "  FUZZ    $$f" && \
	    $$f -max_total_time=$(FUZZ_SECONDS) -artifact_prefix=$$f. -verbosity=0 -print_final_stats=1 $$f.corpus \
	    $$(ls -d tests/fuzz/corpus/$${f##*/fuzz_} 2>/dev/null) || exit 1; done
else
fuzz:
	@sh src/packages.sh fuzz
	@$(MAKE) $(PARALLEL) CONF=fuzz fuzz
endif

.SECONDARY: $(FUZZ_O)
$(B)/fuzz_%: $(B)/obj/tests/fuzz/fuzz_%.o $(B)/librooms.a $(B)/libdepthprec.a | $(B)/build.libs
	$(call say,LD)
	$(Q)$(LINK) -fsanitize=fuzzer -o $@ $^ @$(B)/build.libs -lm

ifeq ($(CONF),coverage)
coverage: check
	@sh tests/coverage.sh $(B)
else
coverage:
	@DEPTHPREC_QUICK=1 $(MAKE) --no-print-directory CONF=coverage coverage
endif

# ---- Lint --------------------------------------------------------------------------------------------------------

LINTS := lint-format lint-clang lint-cppcheck lint-man lint-spell lint-scripts lint-licence lint-types
.PHONY: lint $(LINTS)
lint:
	@sh src/packages.sh lint
	@$(MAKE) $(PARALLEL) --keep-going $(LINTS)

lint-format:
	$(Q)clang-format --dry-run -Werror $(ALL_C) $(ALL_H)

# The page's scripts, by what they are written as in JSDoc.
lint-types:
	$(call say,LINT)
	$(Q)if why=$$(B=$(B) sh tests/web/packages.sh); then $(B)/web/node_modules/.bin/tsc -p tests/web; \
	else echo "left out: types of the page's scripts, as $$why"; fi

# Benchmarks and fuzz targets, too. AFTER_ASAN=1: what `make asan WERROR=-Werror`, which is clang as well, has not judged.
lint-clang: $(B)/build.cflags $(B)/check.cflags
	$(Q)clang -fsyntax-only -std=gnu11 $(INCLUDES) $(WARN_clang) -Werror $(EXACT) @$(B)/build.cflags @$(B)/check.cflags \
	    $(filter-out $(PAGE) $(WINDOWS) $(if $(AFTER_ASAN),$(CORE) $(ROOMS) $(TESTS) $(SUPPORT)),$(ALL_C))

lint-cppcheck:
	$(Q)cppcheck -q -j$(JOBS) --std=c11 --error-exitcode=1 --inline-suppr --enable=warning,performance,portability \
	    --suppress=missingIncludeSystem -Iinclude -Isrc src

lint-man: $(MAN)
	$(Q)mandoc -T lint -W warning $(MAN)

lint-spell:
	$(Q)codespell -L nd,eror,arithmetics,positoin,ue $(wildcard README.md) Makefile include src man $(filter tests/%,$(ALL_C) $(ALL_H)) tests/*.sh

lint-scripts:
	$(Q)for f in $(SCRIPTS); do sh -n $$f || exit 1; done; bash -n .ci/run

lint-licence:
	$(Q)! grep -L 'SPDX-License-Identifier: ' $(ALL_C) $(ALL_H) $(SCRIPTS) Makefile | grep .

# ---- Install -----------------------------------------------------------------------------------------------------

.PHONY: install uninstall installcheck plots bench clean distclean dist deb help
D = $(DESTDIR)
COMPLETIONS := bash-completion/completions/depthprec zsh/site-functions/_depthprec fish/vendor_completions.d/depthprec.fish

install: all man
	$(Q)$(INSTALL) -d "$(D)$(bindir)" "$(D)$(libdir)/pkgconfig" "$(D)$(includedir)/depthprec"
	$(Q)$(INSTALL_PROGRAM) $(B)/depthprec "$(D)$(bindir)/depthprec"
	$(Q)$(INSTALL_PROGRAM) $(B)/libdepthprec.so.0 "$(D)$(libdir)/libdepthprec.so.0"
	$(Q)ln -sf libdepthprec.so.0 "$(D)$(libdir)/libdepthprec.so"
	$(Q)$(INSTALL_DATA) $(B)/libdepthprec.a "$(D)$(libdir)/libdepthprec.a"
	$(Q)sed -e 's|@prefix@|$(prefix)|' -e 's|@libdir@|$(libdir)|' -e 's|@includedir@|$(includedir)|' \
	    -e 's|@version@|$(VERSION)|' src/depthprec.pc.in >"$(D)$(libdir)/pkgconfig/depthprec.pc"
	$(Q)$(INSTALL_DATA) $(HEADERS) "$(D)$(includedir)/depthprec"
	$(Q)for m in $(MAN); do s="$(D)$(mandir)/man$${m##*.}"; $(INSTALL) -d "$$s" && $(INSTALL_DATA) $$m "$$s" || exit 1; done
	$(Q)for f in $(COMPLETIONS); do $(INSTALL) -d "$(D)$(datarootdir)/$${f%/*}" && \
	    $(B)/depthprec completions $$(expr $$f : '\([a-z]*\)') >"$(D)$(datarootdir)/$$f" || exit 1; done
	$(if $(wildcard $(B)/depthprec.html),$(Q)$(INSTALL) -d "$(D)$(docdir)" && $(INSTALL_DATA) $(B)/depthprec.html "$(D)$(docdir)")
	$(if $(D),,@sh src/loader.sh "$(libdir)")

uninstall:
	$(Q)rm -f "$(D)$(bindir)/depthprec" "$(D)$(libdir)/libdepthprec.so.0" "$(D)$(libdir)/libdepthprec.so" \
	    "$(D)$(libdir)/libdepthprec.a" "$(D)$(libdir)/pkgconfig/depthprec.pc"
	$(Q)for m in $(notdir $(MAN)); do rm -f "$(D)$(mandir)/man$${m##*.}/$$m"; done
	$(Q)rm -rf "$(D)$(includedir)/depthprec"
	$(Q)rm -f "$(D)$(docdir)/depthprec.html"
	$(Q)for f in $(COMPLETIONS); do rm -f "$(D)$(datarootdir)/$$f"; done

installcheck:
	$(Q)"$(D)$(bindir)/depthprec" --version
	$(Q)"$(D)$(bindir)/depthprec" table -n 0.1 -f 1000 -F unorm24 -m d3d --at 10 --csv | grep -q ',16611104,'

# ---- The rest ----------------------------------------------------------------------------------------------------

plots: all
	@sh plots/draw.sh $(B)/depthprec plots

BENCHED := interval linearize encode worst position normal
bench: all $(BENCH_PROGRAMS)
	@! command -v python3 >/dev/null || $(MAKE) --no-print-directory wheel
	@sh tests/bench.sh $(foreach b,$(filter-out %/bench_empty,$(BENCH_PROGRAMS)),'$b $(B)/depthprec') \
	    $(foreach f,$(BENCHED),'echo && $(B)/depthprec methods $f') \
	    'mkdir -p $(B)/bench && sh plots/draw.sh $(B)/depthprec $(B)/bench pareto-interval pareto-linearize' \
	    $(if $(shell command -v python3),"echo && B=$(B) CC='$(CC)' python3 tests/python/bench.py")

clean distclean:
	$(Q)rm -rf build

dist:
	@for p in docs windows deb; do sh src/packages.sh $$p || exit 1; done
	@sh .ci/dist.sh

deb:
	@sh src/packages.sh deb
	@sh .ci/deb.sh

help:
	@sed -n 's/^## \{0,1\}//p' Makefile

## make demo        install what is missing, build, print the table of one camera and draw its figures
## make             build the library and the program into build/: needs cairo, GSL, jansson, libpng and zlib. Of OpenEXR, TIFF,
##                  assimp, Vulkan, EGL and GL it uses the headers that are here: tables and figures need none
## make check       install what is missing, build, run the tests: some 10 minutes on two cores
##                  what is left out because a program is not here it names last, with what installs it
## make check-full  4 times the cases (DEPTHPREC_FULL=1000 in front of one test: all), and check-web, check-probe, cross,
##                  cross-windows and check-dist: hours, before a release (Debian)
## make check-baseline  the tests that know it, without AVX
## make check-probe  a Vulkan driver without a GPU, and what the probe finds there (Debian): a part, see check-full
## make cross       built for MACHINES="aarch64 s390x" and run, emulated: the tests, and the same bytes as here (Debian)
## make cross-windows  the same for Windows, by Wine
## make asan        the tests, built by clang, under the address and undefined-behaviour sanitizers
## make fuzz        each fuzz target for FUZZ_SECONDS=20 (needs clang)
## make mutants     whether the tests notice the changes of the source in tests/mutants.txt: two hours (ROOM=, ONLY=)
## make coverage    the lines that the tests reach, per file
## make lint        format, warnings of clang, cppcheck, manual pages, spelling, scripts, licences, types of scripts
## make plots       draw the gallery in plots/ again
## make bench       measure the speed of the engine and the methods, charts of the latter in build/bench; last, which aims
##                  are met
## make check-web       the page in Chromium, which it installs: a minute of it: what it shows against the program, bad
##                  addresses; DEPTHPREC_FULL=1 adds keyboard, speed and more
## make web         the page for the browser, build/depthprec.html, and the core as WebAssembly, build/web/core.wasm
## make docs        all pages as HTML, the manual with its figures and the page, in build/docs: opens from disk, and may be
##                  served as it is (Debian)
## make wheel       the Python package: a wheel and its sources in build/dist (needs python3)
## make windows     build/windows/depthprec.exe and the library as a DLL, by mingw-w64; fetches the sources of its libraries
##                  from Debian once
## make npm         the npm package, for node and browsers, in build/dist
## make man         the manual pages in build/man/, completed with what the program says of itself
## make packages    install what building and testing need
## make install     to PREFIX=/usr/local (DESTDIR, bindir, libdir, ... as usual), with the page once `make web` has made it;
##                  uninstall, installcheck
## make dist        what is released, into build/dist: sources, Debian's packages, Python's, npm's, Windows', the page, all
##                  pages as HTML, SHA256SUMS (Debian); make clean removes build/
## make deb         Debian's source package and three packages in build/deb/, judged by lintian (Debian)
##
## CONF=release|asan|coverage|fuzz  V=1 shows the commands  CC, CFLAGS, CPPFLAGS, LDFLAGS as usual
## B=FOLDER builds there, not in build/  JOBS=N as many at once  MINGW, WINDOWS_CC, WINDRES another mingw-w64  WEB_CC another clang
## WERROR=-Werror makes warnings errors

-include $(B)/baseline/batch.d $(patsubst %.o,%.d,$(CORE_O) $(ROOMS_O) $(TESTS_O) $(SUPPORT_O) $(FUZZ_O) $(B)/obj/src/windows/fma.d $(PLAIN_O) $(WINDOWS_CORE_O) $(WINDOWS_O) $(WEB_CORE_O) $(WEB_O) $(NPM_O) $(NPM_DOOR_O) $(SAMPLES_O))
