"""Where a lab shows its pictures and numbers. All that an update changes travels in one message and is painted in one frame."""

from __future__ import annotations

from collections.abc import Sequence

import anywidget
import traitlets

from priorlab.widgets.picture import Picture

_ESM = """
const isSvg = bytes => bytes.getUint8(0) === 60;  // "<"; a PNG begins with 137
function render({ model, el }) {
  el.classList.add("priorlab-screen");
  const places = model.get("widths").map(width => ({ width, bytes: null, alt: null, box: null }));
  const readout = document.createElement("div");
  let said = "";
  readout.className = "priorlab-readout";
  readout.setAttribute("role", "status");  // new numbers are announced politely
  el.append(readout);

  const boxOf = (place, svg) => {  // a canvas takes decoded pixels as they are; an SVG becomes part of the page
    const box = document.createElement(svg ? "div" : "canvas");
    box.className = "priorlab-picture";
    box.setAttribute("role", "img");
    if (place.width) box.style.width = place.width + "px";
    const next = places.slice(places.indexOf(place) + 1).find(one => one.box);
    el.insertBefore(box, next ? next.box : readout);
    return box;
  };
  const fitting = new ResizeObserver(seen => {  // sharp when large, whole when small
    for (const { target, contentRect } of seen)
      target.style.imageRendering = target.width > contentRect.width + 0.5 ? "auto" : "pixelated";
  });
  const paint = (place, bytes, bitmap) => {
    place.box ??= boxOf(place, !bitmap);
    if (!bitmap) {
      place.box.innerHTML = new TextDecoder().decode(bytes);
      if (place.width) place.box.firstElementChild.style.width = "100%";
      return;
    }
    const canvas = place.box;
    const sized = canvas.width === bitmap.width && canvas.height === bitmap.height;
    if (!sized) {
      [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
      fitting.unobserve(canvas);
      fitting.observe(canvas);
    }
    canvas.getContext("bitmaprenderer").transferFromImageBitmap(bitmap);
  };
  const show = async () => {
    const fresh = places
      .map((place, i) => ({ place, bytes: model.get("image_" + i) }))
      .filter(({ place, bytes }) => bytes?.byteLength && bytes !== place.bytes);
    for (const { place, bytes } of fresh) place.bytes = bytes;
    const bitmaps = await Promise.all(
      fresh.map(({ bytes }) => (isSvg(bytes) ? null : createImageBitmap(new Blob([bytes], { type: "image/png" }))))
    );
    fresh.forEach(({ place, bytes }, i) => {
      if (place.bytes === bytes) paint(place, bytes, bitmaps[i]);
      else bitmaps[i]?.close();  // a newer one came while this was decoded
    });
    places.forEach((place, i) => {
      const alt = model.get("alt_" + i);
      if (place.box && alt !== place.alt) place.box.setAttribute("aria-label", (place.alt = alt));
    });
    const words = model.get("readout");
    if (words !== said) readout.innerHTML = said = words;
    el.dispatchEvent(new Event("priorlab-shown"));
  };
  model.on("change", show);
  show();
  return () => {
    model.off("change", show);
    fitting.disconnect();
  };
}
export default { render };
"""

_CSS = """
.priorlab-screen { display: flex; flex-flow: row wrap; align-items: flex-start; gap: 4px; min-width: 0; max-width: 100%; }
.priorlab-picture { max-width: calc(100% - 2px); height: auto; background: #fff; border: 1px solid #888; }
.priorlab-picture svg { display: block; max-width: 100%; height: auto; }
.priorlab-readout { flex: 1 1 24em; min-width: 0; margin: 0 0.6em; }  /* beside or below, whatever the numbers' length */
.priorlab-readout table { border-spacing: 0; }
.priorlab-readout td { padding: 1px 12px 1px 0; line-height: 1.35; text-align: left; vertical-align: top; }
.priorlab-readout td:first-child { white-space: nowrap; }
.priorlab-readout td + td { font-variant-numeric: tabular-nums; }
"""


class Screen(anywidget.AnyWidget):
    """Pictures side by side, and the readout beside them.

    Parameters
    ----------
    pictures : as many as will ever be shown, with their widths

    >>> picture = Picture(width=300)
    >>> screen = Screen([picture])
    >>> picture.show_svg("<svg/>", "nothing")
    >>> screen.show([picture], "no numbers")
    >>> screen.image_0, screen.alt_0, screen.readout
    (b'<svg/>', 'nothing', 'no numbers')
    """

    _esm = _ESM
    _css = _CSS

    widths = traitlets.List(traitlets.Int()).tag(sync=True)
    readout = traitlets.Unicode("").tag(sync=True)

    def __init__(self, pictures: Sequence[Picture]) -> None:
        super().__init__(widths=[picture.width for picture in pictures])
        for i in range(len(pictures)):  # a trait each: an unchanged picture does not travel
            image, alt = traitlets.Bytes(b"").tag(sync=True), traitlets.Unicode("").tag(sync=True)
            self.add_traits(**{f"image_{i}": image, f"alt_{i}": alt})

    def show(self, pictures: Sequence[Picture], readout: str) -> None:
        """Show the pictures as they are now, and the readout, HTML."""
        with self.hold_sync():  # one message: pictures, words and numbers never disagree
            for i, picture in enumerate(pictures):
                self.set_trait(f"image_{i}", picture.image)
                self.set_trait(f"alt_{i}", picture.alt)
            self.readout = readout
