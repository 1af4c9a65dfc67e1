/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/device.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define MM        1e-3
#define MICROSOFT "Microsoft, "
#define REALSENSE                                                                                                      \
    "Intel, RealSense D400 Series Product Family Datasheet, 337029: baseline, field of view; "                         \
    "librealsense, disparity-transform.cpp: 5 fractional bits; its issue 3039: 126 disparities"
#define REALSENSE_FOR "focal length at 1280 pixels by the field of view, at which 126 pixels are nearest"
/* Half the width in pixels over the tangent of half the angle. */
#define D415_FOCAL 1004.599 /* 65 degrees */
#define D435_FOCAL 674.419  /* 87 degrees */

/* The zero plane of PrimeSense's cameras lies at 1200 mm, its pixels are .1042 mm there at 1280 pixels, and shifts of
 * 1/4 pixel are counted from 800 - 4 x .375: 8 times a disparity at 640 pixels. */
#define PRIMESENSE        575.815739, 0.075, -0.125, 136.175984
#define PRIMESENSE_SOURCE "OpenNI2, PS1080, XnShiftToDepth.cpp, with its default parameters"

/* clang-format off */
static const device_row rows[] = {
    {"kinect1", "Microsoft Kinect for Xbox 360, structured light: millimetres, or OpenNI's 11 bits, eighths of a pixel",
     MM, GRAIN_INVERSE, PRIMESENSE, 0.4, 10, false,
     PRIMESENSE_SOURCE "; Khoshelham and Elberink, Sensors 12(2), 2012", false},
    {"xtion", "ASUS Xtion Pro Live, Structure Sensor and other cameras of PrimeSense: as kinect1",
     MM, GRAIN_INVERSE, PRIMESENSE, 0.35, 10, false, PRIMESENSE_SOURCE, true},
    {"kinect2", "Microsoft Kinect for Xbox One, time of flight: millimetres, finer than its noise",
     MM, GRAIN_EVEN, 0, 0, MM, 0, 0.5, 8, false,
     MICROSOFT "Kinect for Windows SDK 2.0, DepthFrame class: at most 8 m, reliable up to 4.5", false},
    {"azure-kinect", "Microsoft Azure Kinect DK, time of flight: millimetres",
     MM, GRAIN_EVEN, 0, 0, MM, 0, 0.25, 5.46, false,
     MICROSOFT "Azure Kinect DK hardware specifications: wide from 0.25 m, narrow and binned to 5.46 m", false},
    {"d415", "Intel RealSense D415, stereo: millimetres, or disparity in 1/32 pixel; " REALSENSE_FOR,
     MM, GRAIN_INVERSE, D415_FOCAL, 0.055, 1.0 / 32, 0, 0.44, 10, false, REALSENSE, false},
    {"d435", "Intel RealSense D435, stereo: as d415",
     MM, GRAIN_INVERSE, D435_FOCAL, 0.05, 1.0 / 32, 0, 0.27, 10, false, REALSENSE, false},
    {"d455", "Intel RealSense D455, stereo: as d415",
     MM, GRAIN_INVERSE, D435_FOCAL, 0.095, 1.0 / 32, 0, 0.51, 10, false, REALSENSE, false},
    {"oak-d", "Luxonis OAK-D, stereo at 1280 x 800: millimetres, or disparity in whole pixels; step=1/8 with subpixel",
     MM, GRAIN_INVERSE, 882.5, 0.075, 1, 0, 0.35, 15, false,
     "Luxonis, OAK-D: MinZ 35 cm extended, MaxZ 15 m; Configuring Stereo Depth: 882.5 pixels", false},
    {"zed2", "Stereolabs ZED 2 and 2i, stereo, by a neural network: 32-bit floats or whole millimetres",
     MM, GRAIN_FINE, 0, 0.12, 0, 0, 0.3, 20, false,
     "Stereolabs, ZED SDK, Depth Settings: range at a focal length of 2.1 mm; DEPTH_U16_MM", false},
    {"astra", "Orbbec Astra, structured light: millimetres; its shifts are not published",
     MM, GRAIN_FINE, 0, 0, 0, 0, 0.6, 8, false, "Orbbec, Astra 2 Datasheet 1.0: range", false},
    {"tum", "TUM RGB-D, 5000 to the metre: kinect1's millimetres, stored again",
     0.2 * MM, GRAIN_INVERSE, PRIMESENSE, 0.4, 10, false, "TUM, RGB-D SLAM Dataset and Benchmark, File Formats", false},
    {"icl", "ICL-NUIM, 5000 to the metre: rendered depth",
     0.2 * MM, GRAIN_FINE, 0, 0, 0, 0, 0.1, 13, false, "Handa et al., ICRA 2014; TUM's format", true},
    {"sun", "SUN RGB-D and SUN3D: millimetres rotated up by three bits; four cameras",
     MM, GRAIN_FINE, 0, 0, 0, 0, 0.3, 10, false, "Song et al., CVPR 2015, SUNRGBDtoolbox, read3dPoints.m", true},
    {"nyu", "NYU Depth V2: metres by kinect1; its raw frames hold OpenNI's 11 bits, bytes swapped",
     1, GRAIN_INVERSE, PRIMESENSE, 0.4, 10, false,
     "Silberman et al., ECCV 2012, toolbox, depth_rel2depth_abs.m", false},
    {"scannet", "ScanNet, by a Structure Sensor: millimetres",
     MM, GRAIN_INVERSE, PRIMESENSE, 0.35, 10, false, "Dai et al., CVPR 2017, SensReader: depth shift 1000", true},
    {"kitti", "KITTI depth, by a laser scanner: 256 to the metre",
     1.0 / 256, GRAIN_EVEN, 0, 0, 1.0 / 256, 0, 1, 120, false,
     "Uhrig et al., 3DV 2017, development kit, readme.txt", true},
    {"kitti-stereo", "KITTI stereo 2012 and 2015: disparity in 1/256 pixel; each scene has its calibration",
     0, GRAIN_INVERSE, 721.5377, 0.532725, 1.0 / 256, 0, 1.5, 200, false,
     "Menze and Geiger, CVPR 2015, development kit, readme.txt; calibration of 2011_09_26, P2 and P3", true},
    {"cityscapes", "Cityscapes: disparity, (sample - 1)/256 pixel; each scene has its calibration",
     0, GRAIN_INVERSE, 2262.52, 0.209313, 1.0 / 256, -1.0 / 256, 3, 1000, false,
     "Cordts et al., CVPR 2016, cityscapesScripts, README.md; camera.json of Aachen", true},
    {"middlebury", "Middlebury 2014: disparity in PFM, inf where unknown; calibrated for each scene, here Motorcycle",
     0, GRAIN_FINE, 3979.911, 0.193001, 1, 124.343, 1, 20, false, "Scharstein et al., GCPR 2014; scenes2014", true},
    {"diode", "DIODE, by a laser scanner: metres in .npy",
     1, GRAIN_FINE, 0, 0, 0, 0, 0.6, 350, false,
     "Vasiljevic et al., 2019, diode-devkit, README.md: metres; its scanner, a FARO Focus S350: range", false},
    {"hypersim", "Hypersim, rendered: metres along the ray, binary16",
     1, GRAIN_HALF, 0, 0, 0, 0, 0.01, 500, true, "Roberts et al., ICCV 2021, ml-hypersim, README.md", true},
    {"matterport", "Matterport3D: 4000 to the metre",
     0.25 * MM, GRAIN_FINE, 0, 0, 0, 0, 0.2, 16.4, false, "Chang et al., 3DV 2017, data_organization.md", true},
};
/* clang-format on */

const device_row *device_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

sensor device_sensor(const device_row *row) {
    const double none = (double)NAN;
    sensor s = {.step = none, .offset = none, .levels = none};
    if (row->levels == GRAIN_INVERSE)
        s.step = fabs(row->step) / (row->focal * row->baseline);
    else if (row->levels == GRAIN_EVEN)
        s.step = row->step;
    for (size_t i = 0; sensor_get(i) != NULL; i++)
        if (sensor_get(i)->levels == row->levels)
            s.row = sensor_get(i);
    return s;
}

/* Steps of devices that were measured, with what is off, and of files; or of a row. */
static const struct known_step {
    grain_levels levels;
    const char *row; /* null: the step stands here */
    double step, within;
    const char *name;
} known_steps[] = {
    {GRAIN_INVERSE, "kinect1", 0, 0.004, "Kinect 1: eighths of a pixel, 75 mm apart, 575.8 pixels"},
    {GRAIN_INVERSE, NULL, 1 / 29.896, 0.002, "OAK-D: whole pixels, baseline times focal length 29.896 m"},
    {GRAIN_INVERSE, NULL, 1.0 / 10100, 1e-4, "compressedDepth of ROS, quantization 100"},
};

static double step_of(const struct known_step *k) {
    double step = k->step;
    for (size_t i = 0; k->row != NULL && i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].name, k->row) == 0)
            step = device_sensor(&rows[i]).step;
    return step;
}

const char *device_like(grain_levels levels, double step) {
    for (const struct known_step *k = known_steps; k < known_steps + sizeof known_steps / sizeof *known_steps; k++)
        if (k->levels == levels && fabs(step - step_of(k)) <= k->within * step_of(k))
            return k->name;
    return NULL;
}
