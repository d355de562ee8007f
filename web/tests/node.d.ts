// SPDX-License-Identifier: BSD-3-Clause
// What the tests use of Node.

declare module "node:test" {
  export function test(name: string, body: () => void): void;
}

declare module "node:assert/strict" {
  export function equal(actual: unknown, wanted: unknown): void;
  export function deepEqual(actual: unknown, wanted: unknown): void;
  export function ok(value: unknown): void;
}
