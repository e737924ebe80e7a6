// SPDX-License-Identifier: GPL-3.0-or-later
// The strip under the face that says what its colours mean.
import { rampStops } from './colour';
import { ticksOf, type Scale } from './colouring';

/** Fills the figure with title, unit, bar and ticks; hidden where the colours are the skin's own. */
export function drawColourBar(figure: HTMLElement, scale: Scale | null): void {
  figure.hidden = !scale;
  if (!scale) return;
  const caption = document.createElement('figcaption');
  const unit = document.createElement('span');
  unit.className = 'unit';
  unit.textContent = scale.unit;
  caption.append(scale.title, ' ', unit);
  const bar = document.createElement('div');
  bar.className = 'bar';
  bar.style.background = `linear-gradient(to right, ${rampStops(scale.ramp).join(', ')})`;
  const ticks = document.createElement('div');
  ticks.className = 'ticks';
  const values = ticksOf(scale);
  ticks.append(
    ...values.map(({ text, share }) => {
      const tick = document.createElement('span');
      tick.textContent = text;
      tick.style.left = `${100 * share}%`;
      return tick;
    }),
  );
  const scaled = document.createElement('div');
  scaled.className = 'scaled';
  scaled.setAttribute('role', 'img');
  scaled.setAttribute('aria-label', `Colours from ${values[0].text} to ${values.at(-1)!.text} ${scale.unit}`);
  scaled.append(bar, ticks);
  const remark = document.createElement('p');
  remark.textContent = remark.title = scale.remark;
  figure.replaceChildren(caption, scaled, ...(scale.remark ? [remark] : []));
}
