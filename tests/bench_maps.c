/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Maps as whole processes: a depth image of 3840 x 2160 codes of unorm24 is read from .npy, and what is made of it
 * written to .npy, beside a process that reads and writes as many bytes and does nothing else. All take turns; the
 * least counts. Then the same on one thread and on all while another process keeps a core busy: nobody may wait for a
 * thread that lost its core. Memory is what a process held at most beyond its images, the one that was read and those
 * written, which it holds a strip at a time.
 */
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "aims.h"
#include "image/image.h"
#include "timing.h"

enum { WIDTH = 3840, HEIGHT = 2160, RUNS = 5, BLOCK = 1 << 16, WORDS = 32 };

static const double image_bytes_each = 4.0 * WIDTH * HEIGHT;
static char folder[] = "/tmp/depthprec-bench-XXXXXX";
static const char *program;

typedef struct way {
    const char *name, *words;
    int planes; /* written, of 4 bytes a pixel */
    aim_id aim; /* AIM_COUNT: none */
} way;

static const way ways[] = {
    {"eye depth", "--product eye -o out.npy", 1, AIM_COUNT},
    {"  and its error", "--product eye -o out.npy --error-map=error.npy", 2, AIM_EYE_MAP},
    {"places", "--product position:view -o out.npy", 3, AIM_COUNT},
    {"  and their errors", "--product position:view -o out.npy --error-map=error.npy", 4, AIM_PLACES_MAP},
    {"normals", "--product normal:projective -o out.npy", 3, AIM_COUNT},
    {"  and their errors", "--product normal:projective -o out.npy --error-map=error.npy", 4, AIM_NORMALS_MAP},
    {"statistics", "-o out.txt", 0, AIM_STATISTICS},
    {"a figure of 3840 px", "--figure out.png --figure-size 3840", 0, AIM_FIGURE},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

/* The cost of a process: seconds, of all cores, and bytes. */
typedef struct cost {
    double wall, cpu, memory;
} cost;

static double seconds(struct timeval t) {
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* As many bytes as a way moves, through the same calls. */
static void move_bytes(int planes) {
    char *const bytes = malloc((size_t)image_bytes_each), block[BLOCK];
    FILE *const in = fopen("in.npy", "rb");
    if (bytes == NULL || in == NULL || fread(bytes, 1, (size_t)image_bytes_each, in) == 0)
        _exit(2);
    for (int k = 0; k < planes; k++) {
        const int out = open(k == 0 ? "out.npy" : "error.npy", O_WRONLY | O_CREAT | (k < 2 ? O_TRUNC : O_APPEND), 0666);
        for (size_t i = 0; i + BLOCK <= (size_t)image_bytes_each; i += BLOCK) {
            memcpy(block, bytes + i, BLOCK);
            if (write(out, block, BLOCK) != BLOCK)
                _exit(2);
        }
        close(out);
    }
    _exit(0);
}

static void run_program(const char *words, int threads) {
    char line[512], *argv[WORDS], *rest = line;
    int argc = 0;
    snprintf(line, sizeof line, "depthprec texture in.npy -n 0.1 -f 1000 -F unorm24 -m d3d -q --threads %d %s", threads,
             words);
    for (char *word; argc < WORDS - 1 && (word = strtok_r(rest, " ", &rest)) != NULL;)
        argv[argc++] = word;
    argv[argc] = NULL;
    execv(program, argv);
    _exit(2);
}

/* words: null for the floor. */
static cost measure(const char *words, int planes, int threads) {
    struct rusage used;
    int status;
    const double start = timing_now();
    const pid_t child = fork();
    if (child == 0 && words == NULL)
        move_bytes(planes);
    if (child == 0)
        run_program(words, threads);
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) {
        fprintf(stderr, "bench_maps: %s failed\n", words != NULL ? words : "copying");
        exit(2);
    }
    return (cost){timing_now() - start, seconds(used.ru_utime) + seconds(used.ru_stime),
                  1024.0 * (double)used.ru_maxrss};
}

static void compare_with_floor(int threads) {
    static timing wall[WAYS][2], cpu[WAYS][2];
    static double memory[WAYS];
    for (int run = -1; run < RUNS; run++)
        for (int i = 0; i < WAYS; i++)
            for (int floor = 0; floor < 2; floor++) {
                const cost c = measure(floor ? NULL : ways[i].words, ways[i].planes, threads);
                if (run < 0)
                    continue;
                timing_add(&wall[i][floor], c.wall);
                timing_add(&cpu[i][floor], c.cpu);
                if (!floor)
                    memory[i] = fmax(memory[i], c.memory - image_bytes_each);
            }
    printf("\nmaps as processes, %d threads   s   moving   ratio  CPU s   ratio  MiB more   aim\n", threads);
    for (int i = 0; i < WAYS; i++) {
        const double taken = timing_least(&wall[i][0]), floor = timing_least(&wall[i][1]);
        const double used = timing_least(&cpu[i][0]), floor_used = timing_least(&cpu[i][1]);
        printf("%-24s %8.3f %8.3f %7.1f %6.2f %7.1f %9.1f", ways[i].name, taken, floor, taken / floor, used,
               used / floor_used, memory[i] / 0x1p20);
        if (ways[i].aim != AIM_COUNT)
            aim_judge(ways[i].aim, ways[i].words, taken);
        if (ways[i].aim == AIM_FIGURE)
            aim_judge(AIM_FIGURE_MEMORY, ways[i].words, memory[i] / 0x1p20);
        printf("\n");
    }
}

static void compare_under_load(int threads) {
    printf("\nbeside a process that keeps a core busy, s   1 thread  %d threads   ratio   aim\n", threads);
    for (int i = 1; i < WAYS; i += 2) {
        timing taken[2] = {{.count = 0}};
        const pid_t busy = fork();
        if (busy == 0)
            for (volatile unsigned spin = 0;; spin++)
                ;
        for (int run = 0; run < RUNS; run++)
            for (int t = 0; t < 2; t++)
                timing_add(&taken[t], measure(ways[i].words, 0, t == 0 ? 1 : threads).wall);
        kill(busy, SIGKILL);
        waitpid(busy, NULL, 0);
        const double one = timing_least(&taken[0]), all = timing_least(&taken[1]);
        printf("%-42s %8.3f %10.3f %7.2f", ways[i].name, one, all, all / one);
        aim_judge(AIM_LOADED, ways[i].words, all / one);
        printf("\n");
    }
}

/* Hills with steps between them, and noise. */
static void fill(void) {
    FILE *const file = fopen("in.npy", "wb");
    image_writer *w = file != NULL ? image_writer_open(file, IMAGE_NPY, IMAGE_U32, WIDTH, HEIGHT, 1, NULL) : NULL;
    static uint32_t row[WIDTH];
    uint32_t noise = 1;
    for (uint32_t y = 0; y < HEIGHT && w != NULL; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            const double hill = 20 + 5 * sin(0.004 * x) + 4 * cos(0.006 * y);
            noise = noise * 1664525u + 1013904223u;
            const double z = (x / 97 + y / 61) % 5 == 0 ? 0.5 * hill : hill, rough = z + 0.001 * (noise >> 16) / 65536;
            row[x] = (uint32_t)(1000 / 999.9 * (1 - 0.1 / rough) * 16777215 + 0.5);
        }
        image_writer_rows(w, row, 1);
    }
    if (w == NULL || !image_writer_close(w) || fclose(file) != 0)
        exit(2);
}

static void clean(void) {
    static const char *const names[] = {"in.npy", "out.npy", "error.npy", "out.txt", "out.png"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        unlink(names[i]);
    if (chdir("/") == 0)
        rmdir(folder);
}

int main(int argc, char **argv) {
    const int threads = (int)sysconf(_SC_NPROCESSORS_ONLN);
    program = argc > 1 ? realpath(argv[1], NULL) : NULL;
    if (program == NULL || mkdtemp(folder) == NULL || chdir(folder) != 0) {
        fprintf(stderr, "usage: bench_maps DEPTHPREC\n");
        return 2;
    }
    fill();
    compare_with_floor(threads);
    compare_under_load(threads);
    clean();
    return 0;
}
