/* SPDX-License-Identifier: GPL-3.0-or-later */
/* On a terminal nothing is wider than it is: of every command what it prints, helps, refuses and warns of. */
#define _GNU_SOURCE /* posix_openpt() */
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include "cli/commands.h"
#include "printed.h"

#define HOUSE "tests/models/house.gltf"

static const char *const lines[] = {
    "help",
    "help options",
    "--version",
    "list",
    "list formats",
    "list presets",
    "list platforms",
    "list apis",
    "list rasterizers",
    "list effects",
    "list methods",
    "list D24_UNORM",
    "table",
    "table -F d24 -m d3d",
    "table --viewport 1920x1080",
    "table -F d24 -m d3d --viewport 1920x1080 --slant 30:30",
    "table --preset unity,unreal --at 100m",
    "table --preset three -m logarithmicDepthBuffer,gl --at 1000 --viewport 640x480",
    "table -F d24 -m d3d --depth 0.9987",
    "table -F d24 -m d3d --range 1:100 --tolerance 5%",
    "budget -F d24 -m d3d",
    "budget -F fp32 -m reversed --from-origin 5km --linearize --at 10m",
    "budget -F fp32 -m reversed --viewport 1920x1080 --raster spec-d3d",
    "solve --for distance -F d24 -m d3d --separation 0.01",
    "solve -F d24 -m d3d -f 10000 --separation 0.01 --at 5000",
    "solve --for frusta -n 0.1 -f 1e6 -F d24 -m d3d --separation 0.01",
    "check tests/needs/engine.need",
    "zfight -F d24 -m d3d --range 1:1.1",
    "zfight -F d24 -m gl --separation 0.01 --range 10:10.5",
    "zfight -f inf -F fp32 -m reversed --range 0.1:1e9 --sample 1000",
    "prepass -F d24 -m d3d --sample 1000",
    "prepass -F fp32 -m d3d --prepass-format d16,float4.20b15",
    "prepass -F d24 -m d3d --resolve all:16",
    "bias --api gl -F d24 -m gl --units -1 --at 1,10,100",
    "bias --api all --separation 0.02 --at 300",
    "bias --api d3d12,vulkan --separation 0.02 --at 300 -F d24 -m d3d",
    "bias --api d3d12,vulkan --separation 0.02 --at 300 -F d24,fp32 -m d3d,reversed",
    "bias --preset bevy --api vulkan --units 4 --factor 1 --slope 0.02",
    "bias -F d24 -m d3d --viewport 1920x1080",
    "world --from-origin 100km --separation 1cm --at 10m",
    "world --at 1m",
    "scene " HOUSE " -F d24 -m d3d --camera street --within 60",
    "texture --synthetic plane --size 64x48 -F d24 -m d3d",
    "texture --synthetic decals --size 64x48 -F d24 -m d3d --pixel 32,18",
    "texture --synthetic plane --size 64x48 -F d16 -m d3d --product effect:fog",
    "texture --product effect:intersection",
    "texture --product effect:shadow -F d24 -m d3d",
    "shadow -f 150 --unit m",
    "shadow --light-box 40x40x200 -F d16 --api gl",
    "shadow -f 300 --api all",
    "methods",
    "convert unorm10 d32f unorm10 --write cut:2^10",
    "convert unorm10 d32f unorm10 --code 1,2",
    "plot map -o nowhere/map.svg",
    "plot",
    "plot nothing",
    "list languages",
    "code foo",
    "judge --pairs tests/pairs/reversed.csv -n 0.1 -f 1000 -m d3d",
    "probe --device 99",
    "table -F unknown",
    "table --near -5",
    "table 0.1 1000",
    "list nothing",
    ("texture " HOUSE),
    "texture --product effect:ssao",
    "completions tcsh",
};

/* Runs a command on a terminal of so many columns, through a pager unless that is "". @return what came there, to be
 * freed */
static char *on_terminal(const char *line, unsigned short columns, const char *pager) {
    const char *program = getenv("DEPTHPREC");
    char command[1024];
    snprintf(command, sizeof command, "%s %s", program != NULL ? program : "build/depthprec", line);
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    assert_true(master >= 0 && grantpt(master) == 0 && unlockpt(master) == 0);
    const int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
    assert_true(terminal >= 0);
    const struct winsize size = {.ws_row = 50, .ws_col = columns};
    assert_int_equal(ioctl(terminal, TIOCSWINSZ, &size), 0);
    const pid_t child = fork();
    if (child == 0) {
        setenv("TERM", "dumb", 1);
        setenv("PAGER", pager, 1); /* less would wait for its reader */
        dup2(terminal, STDOUT_FILENO);
        dup2(terminal, STDERR_FILENO);
        close(terminal);
        close(master);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
        _exit(127);
    }
    assert_true(child > 0);
    close(terminal);
    size_t used = 0, room = 1 << 16;
    char *text = malloc(room);
    for (ssize_t got; (got = read(master, text + used, room - used - 1)) > 0;) {
        used += (size_t)got;
        if (room - used < 4096)
            text = realloc(text, room *= 2);
    }
    text[used] = '\0';
    close(master);
    waitpid(child, NULL, 0);
    return text;
}

/* Progress is drawn over itself, and erases what is behind it. */
static void check_widths(tally *t, const char *line, int columns) {
    char *text = on_terminal(line, (unsigned short)columns, "");
    size_t widest = 0;
    TALLY(t, text[0] != '\0' && strstr(text, "not found") == NULL, "%s: %s", line, text);
    for (const char *at = text; *at != '\0';) {
        const size_t length = strcspn(at, "\r\n\033");
        widest = length > widest ? length : widest;
        TALLY(t, length <= (size_t)columns, "%d columns, %s: %zu, %.*s", columns, line, length, (int)length, at);
        at += length;
        at += strncmp(at, "\033[K", 3) == 0 ? 3 : *at != '\0';
    }
    TALLY(t, columns == 120 || widest > 10, "%s: only %zu wide", line, widest);
    free(text);
}

TEST(nothing_is_wider) {
    static const int widths[] = {40, 80, 120};
    tally t = {.name = "widths"};
    for (size_t k = 0; k < sizeof widths / sizeof widths[0]; k++) {
        for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
            check_widths(&t, lines[i], widths[k]);
        for (size_t i = 0; command_get(i) != NULL; i++) {
            char help[64];
            snprintf(help, sizeof help, "help %s", command_get(i)->name);
            check_widths(&t, help, widths[k]);
        }
    }
    tally_end(&t);
}

/* Each command is among the lines above. */
TEST(all_commands) {
    for (size_t i = 0; command_get(i) != NULL; i++) {
        const size_t length = strlen(command_get(i)->name);
        size_t k = 0;
        while (k < sizeof lines / sizeof lines[0] &&
               (strncmp(lines[k], command_get(i)->name, length) != 0 || (lines[k][length] & ~' ') != 0))
            k++;
        if (k == sizeof lines / sizeof lines[0])
            fail_msg("%s is not tried", command_get(i)->name);
    }
}

/* Through a pager, too, lines are as long as the terminal has columns, and none that are shorter fit. */
TEST(pagers_are_as_wide) {
    static const int widths[] = {40, 80, 120};
    for (size_t k = 0; k < sizeof widths / sizeof widths[0]; k++) {
        char *direct = on_terminal("help table", (unsigned short)widths[k], "");
        char *paged = on_terminal("help table", (unsigned short)widths[k], "sed s/^/@/");
        char *from = paged, *to = paged; /* without the marks of the pager's own */
        assert_true(*from == '@');
        for (; *from != '\0'; from++)
            if (*from != '@' || (from > paged && from[-1] != '\n'))
                *to++ = *from;
        *to = '\0';
        assert_string_equal(paged, direct);
        free(direct);
        free(paged);
    }
}

/* A command that is broken can be typed as it stands; what is no terminal keeps its lines. */
TEST(broken_commands) {
    char *text = on_terminal("help bias", 40, "");
    assert_non_null(strstr(text, "  depthprec bias --api gl -F d24 -m gl \\\r\n    --units -1 --at 1,10,100\r\n"));
    assert_non_null(strstr(text, "\n  -n, --near Z\r\n    near plane; "));
    free(text);
    printed p = print_of("help bias");
    assert_non_null(strstr(p.out, "  depthprec bias --preset bevy --api vulkan --units 4 --factor 1 --slope 0.02\n"));
    printed_free(&p);
    p = print_of("list nothing");
    assert_true(strchr(p.errors, '\n') == p.errors + strlen(p.errors) - 1);
    printed_free(&p);
}

/* ---- Set-ups one after another ----------------------------------------------------------------------------------- */

/* Whatever was said of the set-up before, or of the distance: the text of several is that of each alone. */
TEST(each_as_if_alone) {
    static const char *const commands[] = {
        "bias -n 1 -f 10 --units=-5000 --api gl --at 1,5 -F unorm16",
        "bias -n 1 -f 10 --units=3 --api d3d11 --range 2:9 --separation 0.01 -F fp32",
        "bias -n 1 -f 10 --api gl --separation 0.5 -F unorm24",
        "budget -n 1 -f 100 --viewport 640x480 -F fp16",
        "budget -n 1 -f 100 --from-origin 1e6 --linearize -F unorm24",
        "prepass -n 1 -f 9 --sample 1000 -F unorm16",
        "prepass -n 1 -f 9 --prepass-format unorm16,fp16 -F fp32",
        "shadow --light-box 40x40x100 --api gl -F fp32",
        "world --at 5 -f 100 --from-origin 1e9,1 -F unorm16",
        "zfight -n 1 -f 4 --separation 0.01 -F unorm8",
        "zfight -n 1 -f 4 -F fp16"};
    static const char *const both[] = {"d3d", "reversed", "d3d"};
    for (size_t i = 0; i < 2 * sizeof commands / sizeof commands[0]; i++) {
        const char *const *m = both + i % 2, *command = commands[i / 2];
        printed one = print_of("%s -m %s", command, m[0]), next = print_of("%s -m %s", command, m[1]);
        printed together = print_of("%s -m %s,%s", command, m[0], m[1]);
        char *apart;
        assert_true(asprintf(&apart, "%s\n%s", one.out, next.out) > 0);
        assert_string_equal(together.out, apart);
        printed_free(&one);
        printed_free(&next);
        printed_free(&together);
        free(apart);
    }
    static const char world[] = "world --at 5 -f 100 --from-origin %s";
    printed two = print_of(world, "1e9,1"), alone = print_of(world, "1");
    assert_string_equal(strstr(two.out, "\n1 from the origin"), strstr(alone.out, "\n1 from the origin"));
    printed_free(&two);
    printed_free(&alone);
}
