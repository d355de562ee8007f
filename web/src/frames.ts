// SPDX-License-Identifier: BSD-3-Clause
// Drawing on demand: a view is drawn once per frame of the browser at most, and never when nothing changed.

/** Something that can be drawn. */
export interface Drawable {
  draw(): void;
}

/** Views that wait to be drawn. */
export class Frames {
  private readonly waiting = new Set<Drawable>();
  private request = 0;

  /** Draw a view in the next frame. */
  later(view: Drawable): void {
    this.waiting.add(view);
    if (this.request === 0) this.request = requestAnimationFrame(() => this.flush());
  }

  /** Draw everything that waits, now. */
  flush(): void {
    cancelAnimationFrame(this.request);
    this.request = 0;
    const views = [...this.waiting];
    this.waiting.clear();
    for (const view of views) view.draw();
  }
}
