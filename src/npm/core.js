// SPDX-License-Identifier: MIT
// depthprec/core: the library alone, without a way to the command.
export { Camera, DepthprecError, version } from "./camera.js";
