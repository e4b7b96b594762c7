"""A slider that says what it is: a label, a name for screen readers, and the value it shows. Arrow keys move it by a step."""

from __future__ import annotations

from typing import Any

import anywidget
import traitlets

_ESM = """
let count = 0;
function render({ model, el }) {
  const label = document.createElement("label");
  const input = document.createElement("input");
  const output = document.createElement("output");
  input.id = "priorlab-slider-" + count++;
  input.type = "range";
  input.setAttribute("data-lm-suppress-shortcuts", "true");  // arrow keys belong to the slider, not to the notebook
  label.htmlFor = output.htmlFor = input.id;
  const show = () => {  // the range first: a value outside of it would be cut
    for (const name of ["min", "max", "step"]) input[name] = model.get(name);
    label.textContent = model.get("label");
    label.title = input.title = model.get("hint");
    input.setAttribute("aria-label", model.get("label"));
    tell();
  };
  const tell = () => {
    const text = model.get("value").toFixed(model.get("digits"));
    input.value = model.get("value");
    output.textContent = text;
    input.setAttribute("aria-valuetext", text);
  };
  input.addEventListener("input", () => {
    model.set("value", Number(input.value));
    model.save_changes();
  });
  const framing = ["min", "max", "step", "label", "hint", "digits"].map(name => "change:" + name).join(" ");
  model.on("change:value", tell);
  model.on(framing, show);
  show();
  el.classList.add("priorlab-slider");
  el.append(label, input, output);
  return () => {
    model.off("change:value", tell);
    model.off(framing, show);
  };
}
export default { render };
"""

_CSS = """
.priorlab-slider { display: grid; grid-template-columns: 10.5em 11.5em 3.2em; gap: 0.6em; align-items: center; margin: 2px 0; }
.priorlab-slider label { text-align: right; }
.priorlab-slider output { font-variant-numeric: tabular-nums; }
.priorlab-slider input:focus-visible { outline: 2px solid #0072b2; outline-offset: 2px; }
"""


class Slider(anywidget.AnyWidget):
    """One number between `min` and `max`.

    A value that code sets is checked: outside the range there is one sentence and nothing moves.

    >>> p_wall = Slider("p_wall", 0.2, 0.05, 1.0, 0.05)
    >>> p_wall.value = 0.3
    >>> p_wall
    Slider(p_wall = 0.30, 0.05 to 1.00)
    >>> p_wall.value = 3
    Traceback (most recent call last):
    ValueError: p_wall must lie between 0.05 and 1, got 3
    """

    _esm = _ESM
    _css = _CSS

    label = traitlets.Unicode("").tag(sync=True)
    hint = traitlets.Unicode("").tag(sync=True)
    min = traitlets.Float(0.0).tag(sync=True)
    max = traitlets.Float(1.0).tag(sync=True)
    step = traitlets.Float(0.01).tag(sync=True)
    digits = traitlets.Int(2).tag(sync=True)
    value = traitlets.Float(0.0).tag(sync=True, echo_update=False)  # the browser knows what it sent: one message less

    def __init__(self, label: str, value: float, min: float, max: float, step: float, hint: str = "", **traits: Any) -> None:
        digits = traits.pop("digits", 0 if float(step).is_integer() else 2)
        super().__init__(label=label, hint=hint or label, min=min, max=max, step=step, digits=digits, value=value, **traits)

    @traitlets.validate("value")
    def _inside(self, proposal: Any) -> float:
        """The proposed value, or a sentence."""
        value = float(proposal["value"])
        if not self.min - 1e-9 <= value <= self.max + 1e-9:
            raise ValueError(f"{self.label} must lie between {self.min:g} and {self.max:g}, got {value:g}")
        return value

    def __repr__(self) -> str:
        value, low, high = (f"{number:.{self.digits}f}" for number in (self.value, self.min, self.max))
        return f"Slider({self.label} = {value}, {low} to {high})"
