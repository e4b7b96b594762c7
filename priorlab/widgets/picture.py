"""A picture in a notebook that has an alternative text and keeps big pixels sharp."""

from __future__ import annotations

import anywidget
import cv2
import numpy as np
import traitlets
from numpy.typing import NDArray

from priorlab.core.picture import encode_png

_ESM = """
function render({ model, el }) {
  const img = document.createElement("img");
  img.className = "priorlab-picture";
  let url = null;
  const draw = () => {
    const old = url;
    url = URL.createObjectURL(new Blob([model.get("image")], { type: model.get("mime") }));
    img.onload = () => {
      if (old) URL.revokeObjectURL(old);
      img.style.imageRendering = img.naturalWidth > img.clientWidth ? "auto" : "pixelated";  // sharp when large, whole when small
    };
    img.src = url;
  };
  const tell = () => { img.alt = model.get("alt"); };
  const size = () => { img.style.width = model.get("width") ? model.get("width") + "px" : "auto"; };
  model.on("change:image", draw);
  model.on("change:alt", tell);
  model.on("change:width", size);
  tell(); size(); draw();
  el.appendChild(img);
  return () => {
    model.off("change:image", draw);
    model.off("change:alt", tell);
    model.off("change:width", size);
    if (url) URL.revokeObjectURL(url);
  };
}
export default { render };
"""

_CSS = """
.priorlab-picture { max-width: 100%; height: auto; background: #fff; border: 1px solid #888; }
"""


class Picture(anywidget.AnyWidget):
    """An image and the words for those who do not see it (`ipywidgets.Image` has no such trait).

    Traits: `image` (bytes), `mime`, `alt`, `width` (CSS pixels on the screen, 0 = as large as the image).

    >>> picture = Picture(width=300)
    >>> picture.show(np.full((2, 3), 255, dtype=np.uint8), alt="an empty map")
    >>> picture
    Picture(image/png: an empty map)
    """

    _esm = _ESM
    _css = _CSS

    image = traitlets.Bytes(b"").tag(sync=True)
    mime = traitlets.Unicode("image/png").tag(sync=True)
    alt = traitlets.Unicode("").tag(sync=True)
    width = traitlets.Int(0).tag(sync=True)

    def show(self, pixels: NDArray[np.uint8], alt: str) -> None:
        """Show a grey (height, width) or RGB (height, width, 3) image."""
        if 0 < self.width < pixels.shape[1]:  # no wider than it is shown: thin walls stay visible, and less has to travel
            size = (self.width, max(1, round(pixels.shape[0] * self.width / pixels.shape[1])))
            pixels = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
        with self.hold_sync():  # one message: picture and words never disagree
            self.mime, self.image, self.alt = "image/png", encode_png(pixels), alt

    def show_svg(self, svg: str, alt: str) -> None:
        """Show a line drawing."""
        with self.hold_sync():
            self.mime, self.image, self.alt = "image/svg+xml", svg.encode(), alt

    def __repr__(self) -> str:
        return f"Picture({self.mime}: {self.alt})"
