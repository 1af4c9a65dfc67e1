/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that are written anew, by each kind of writer: whole or not at all, with the mode that they had, and not where
 * their owner has said that nobody may. */
#include <errno.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "printed.h"
#include "report/output.h"

/* Each writes more than the two blocks of 512 bytes below. */
static const char *const writers[] = {"table -F d24 -m d3d --at 0.1:1000:log:500 --csv",
                                      "table -F d24 -m d3d --at 0.1:1000:log:500",
                                      "table -F d24 -m d3d --at 0.1:1000:log:500 --json",
                                      "plot share -F d24 -m d3d",
                                      "plot share -F d24 -m d3d --type png",
                                      "texture --synthetic plane --size 64x36 -F unorm16"};
enum { WRITERS = sizeof writers / sizeof writers[0] };

static const char *const names[WRITERS] = {"kept.csv", "kept.txt", "kept.json", "kept.svg", "kept.png", "kept.npy"};

static const char *target_of(size_t writer) {
    return scratch_text(names[writer], "old");
}

/* The files beside a file in its folder. */
static int neighbours(const char *path) {
    char line[600];
    int count = -1;
    snprintf(line, sizeof line, "ls -A \"$(dirname '%s')\" | grep -c depthprec-", path);
    FILE *in = popen(line, "r");
    assert_non_null(in);
    assert_int_equal(fscanf(in, "%d", &count), 1);
    pclose(in);
    return count;
}

static void content_is(const char *path, const char *want, const char *line) {
    char *text = text_of_file(path);
    if (strcmp(text, want) != 0)
        fail_msg("%s: the old file is not what it was", line);
    free(text);
}

TEST(modes_are_kept) {
    static const mode_t modes[] = {0600, 0640, 0644, 0755};
    for (size_t w = 0; w < WRITERS; w++)
        for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++) {
            const char *path = target_of(w);
            struct stat s;
            assert_int_equal(chmod(path, modes[k]), 0);
            printed p = print_of("%s -q -o '%s'", writers[w], path);
            assert_int_equal(p.status, 0);
            assert_int_equal(stat(path, &s), 0);
            if ((s.st_mode & 0777) != modes[k] || s.st_size < 300)
                fail_msg("%s: mode %o, not %o", writers[w], s.st_mode & 0777, modes[k]);
            printed_free(&p);
        }
}

/* A write that ends half-way, because a file may be no larger than that: two blocks, since clang's OpenMP asks for one
 * of shared memory. */
TEST(half_a_file_is_none) {
    for (size_t w = 0; w < WRITERS; w++) {
        const char *path = target_of(w);
        const char *limited = scratch_text("limited", "ulimit -f 2; exec \"$@\"\n");
        const char *program = getenv("DEPTHPREC");
        char line[2048];
        if (program == NULL)
            skip();
        snprintf(line, sizeof line, "sh '%s' '%s' %s -q -o '%s' 2>/dev/null >/dev/null </dev/null", limited, program,
                 writers[w], path);
        const int status = system(line);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_IO)
            fail_msg("%s: ends with %d", writers[w], status);
        content_is(path, "old", writers[w]);
        assert_int_equal(neighbours(path), 0);
    }
}

/* As somebody who is not root, in a folder of theirs. */
static int opened_as_somebody(const char *path, bool checks) {
    enum { SOMEBODY = 65534 };
    const pid_t child = fork();
    if (child == 0) {
        output out;
        if (getuid() == 0 && (setgroups(0, NULL) != 0 || setgid(SOMEBODY) != 0 || setuid(SOMEBODY) != 0))
            _exit(99);
        if (freopen("/dev/null", "w", stderr) == NULL)
            _exit(98);
        if (checks)
            _exit(output_check(path));
        const int status = output_open(&out, path);
        _exit(status == EXIT_FINE ? output_close(&out) : status);
    }
    int status = 0;
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status));
    return WEXITSTATUS(status);
}

TEST(read_only_is_respected) {
    char folder[] = "/tmp/depthprec-owned-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    if (getuid() == 0)
        assert_int_equal(chown(folder, 65534, 65534), 0);
    snprintf(path, sizeof path, "%s/file", folder);
    for (int checks = 0; checks < 2; checks++)
        for (int writable = 0; writable < 2; writable++) {
            FILE *out = fopen(path, "w");
            assert_true(out != NULL && fputs("old", out) >= 0 && fclose(out) == 0);
            if (getuid() == 0)
                assert_int_equal(chown(path, 65534, 65534), 0);
            assert_int_equal(chmod(path, writable ? 0644 : 0444), 0);
            assert_int_equal(opened_as_somebody(path, checks != 0), writable ? EXIT_FINE : EXIT_IO);
            content_is(path, writable && !checks ? "" : "old", "read-only");
            unlink(path);
        }
    rmdir(folder);
}

/* One file by two names, there or not; what can be written by two is none. */
TEST(same_file) {
    char a[512], b[512], link_a[512], hard[512], other[512];
    snprintf(a, sizeof a, "%s", scratch_text("a", "%s", "a"));
    snprintf(other, sizeof other, "%s", scratch_text("other", "%s", "a"));
    snprintf(link_a, sizeof link_a, "%s", scratch_file("link"));
    snprintf(hard, sizeof hard, "%s", scratch_file("hard"));
    snprintf(b, sizeof b, "%.*s/./a", (int)(strrchr(a, '/') - a), a);
    remove(link_a);
    remove(hard);
    assert_int_equal(symlink(a, link_a), 0);
    assert_int_equal(link(a, hard), 0);
    assert_true(output_same_file(a, a) && output_same_file(a, b) && output_same_file(link_a, a));
    assert_true(output_same_file(a, hard) && output_same_file(hard, link_a));
    assert_false(output_same_file(a, other) || output_same_file("/dev/null", "/dev/null"));
    assert_false(output_same_file("/dev", "/dev") || output_same_file(a, "/dev/null"));
    remove(a);
    remove(hard);
    assert_true(output_same_file(a, a) && output_same_file(b, a));
    assert_false(output_same_file(a, other) || output_same_file(a, hard) || output_same_file(a, "/none/a"));
}

/* Places that can be written to later: a file, a new one, a device; not a folder, and nothing within what is none. */
TEST(checked_beforehand) {
    const char *const good[] = {scratch_text("old", "%s", "old"), "/dev/null", "/dev/stderr"};
    assert_int_equal(output_check(good[0]), EXIT_FINE);
    assert_int_equal(output_check(scratch_file("new")), EXIT_FINE);
    assert_int_not_equal(access(scratch_file("new"), F_OK), 0); /* it is not made by looking */
    for (size_t i = 1; i < 3; i++)
        assert_int_equal(output_check(good[i]), EXIT_FINE);
    assert_int_not_equal(output_check("/"), EXIT_FINE);
    assert_int_not_equal(output_check("."), EXIT_FINE);
    assert_int_not_equal(output_check("/none/there"), EXIT_FINE);
    assert_int_not_equal(output_check("/dev/null/there"), EXIT_FINE);
}

/* A pager may be left before all is read, which is no error; of another reader it is told by the exit status. */
TEST(readers_that_leave) {
    for (int paged = 0; paged < 2; paged++) {
        output out;
        const char *const path = scratch_file("left");
        assert_int_equal(output_open(&out, path), EXIT_FINE);
        out.error = EPIPE;
        out.paged = paged != 0;
        assert_int_equal(output_close(&out), paged ? EXIT_FINE : EXIT_IO);
        assert_int_not_equal(access(path, F_OK), 0);
    }
}

/* A link to what is not there yet stays a link: what is written comes to stand where it points. */
TEST(links_to_nowhere) {
    char target[512], link[512];
    for (size_t w = 0; w < WRITERS; w++) {
        struct stat s;
        char name[32];
        snprintf(name, sizeof name, "link-%s", names[w]);
        snprintf(link, sizeof link, "%s", scratch_file(name));
        snprintf(target, sizeof target, "%s", scratch_file(names[w]));
        remove(target);
        remove(link);
        assert_int_equal(symlink(target, link), 0);
        printed p = print_of("%s -q -o '%s'", writers[w], link);
        assert_int_equal(p.status, 0);
        assert_true(lstat(link, &s) == 0 && S_ISLNK(s.st_mode));
        assert_true(lstat(target, &s) == 0 && S_ISREG(s.st_mode) && s.st_size > 0);
        printed_free(&p);
        remove(target);
        remove(link);
    }
}
