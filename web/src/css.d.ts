// SPDX-License-Identifier: BSD-3-Clause
// Style sheets are imported for the bundler alone.

declare module "*.css";
