/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A program without cairo draws as the page does, by src/web/canvas.c; here is what a browser knows and it does not:
 * how wide letters are, and which files are figures. Widths in thousandths of the size, of DejaVu Sans, as cairo
 * measures them; another letter than those of ASCII counts as a wide one.
 */
#include <string.h>
#include <strings.h>

#include "draw/canvas.h"
#include "web/page.h"

enum { FIRST = ' ', LAST = '~', OTHER = 838 };

static const short widths[2][LAST - FIRST + 1] = {
    {318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
     636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
     575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
     611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
     278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838},
    {348, 456,  521, 838, 696, 1002, 872, 306, 457, 457, 523, 838, 380, 415,  380, 365, 696, 696,  696,
     696, 696,  696, 696, 696, 696,  696, 400, 400, 838, 838, 838, 580, 1000, 774, 762, 734, 830,  683,
     683, 821,  837, 372, 372, 775,  637, 995, 837, 850, 733, 850, 770, 720,  682, 812, 774, 1103, 771,
     724, 725,  457, 365, 457, 838,  500, 500, 675, 716, 593, 716, 678, 435,  716, 712, 343, 343,  665,
     343, 1042, 712, 687, 716, 716,  493, 595, 478, 712, 652, 924, 645, 652,  582, 712, 365, 712,  838},
};

double page_measure(const char *text, int length, double size, int bold) {
    long sum = 0;
    for (int i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)text[i];
        if (c >= FIRST && c <= LAST)
            sum += widths[bold != 0][c - FIRST];
        else if (c >= 0xC0) /* the first byte of a letter */
            sum += OTHER;
    }
    return (double)sum * size / 1000;
}

canvas_format canvas_format_of(const char *path) {
    static const char *const endings[CANVAS_FORMAT_COUNT] = {".svg", ".pdf", ".png"};
    const size_t length = strlen(path);
    for (int i = 0; i < CANVAS_FORMAT_COUNT; i++)
        if (length > 4 && strcasecmp(path + length - 4, endings[i]) == 0)
            return (canvas_format)i;
    return CANVAS_FORMAT_COUNT;
}
