/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file zfight_against.h  zfight --against: the same vertices through two vertex programs. */
#ifndef CLI_ZFIGHT_AGAINST_H
#define CLI_ZFIGHT_AGAINST_H

#include "cli/options.h"

/** Compares the programs in every set-up and writes what differs. @return an exit status */
int zfight_against(const options *o);

#endif
