/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program that does nothing: what any process costs. bench_core compares depthprec with it. */
int main(void) {
    return 0;
}
