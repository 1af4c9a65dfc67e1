// SPDX-License-Identifier: MIT
// The library alone: Camera.preset(), which runs the command, is refused.
export { Camera, DepthprecError, version } from "./index.js";
export type { CameraOptions, Codes, Decoded, Integers, Numbers, Reals, Worst } from "./index.js";
