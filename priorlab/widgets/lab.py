"""What every box of sliders shares: presets, reset, several sliders moved at once, and a readout of numbers.

A lab computes nothing itself: `refresh` hands the sliders' values to priorlab and shows what comes back.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import ipywidgets

from priorlab.widgets.picture import Picture
from priorlab.widgets.screen import Screen
from priorlab.widgets.sliders import Slider

_WRAP = ipywidgets.Layout(flex_flow="row wrap", align_items="flex-start")


class Lab(ipywidgets.VBox):
    """Sliders above, pictures and numbers below; `lab.p_wall.value = 0.3` does what a hand on the slider does.

    Parameters
    ----------
    sliders : by the name under which `set` and the presets know them
    presets : for each button the values that it sets; the first is also where `reset` leads
    pictures : side by side under the sliders
    controls : further widgets between the buttons and the pictures
    """

    def __init__(
        self,
        sliders: Mapping[str, Slider],
        presets: Mapping[str, Mapping[str, float]],
        pictures: Sequence[Picture],
        controls: Sequence[ipywidgets.Widget] = (),
    ) -> None:
        self.sliders = dict(sliders)
        self.presets = {name: dict(values) for name, values in presets.items()}
        self.pictures = tuple(pictures)
        self.readout = Readout()
        self.screen = Screen(self.pictures)
        self._held = False
        self._start = {name: slider.value for name, slider in self.sliders.items()}
        self.buttons = {name: self._button(name, values) for name, values in self.presets.items()}
        self.buttons["reset"] = self._button("reset", self._start)
        for slider in self.sliders.values():
            slider.observe(self._moved, "value")
        super().__init__(
            [
                ipywidgets.Box([*self.sliders.values()], layout=_WRAP),
                ipywidgets.Box([*self.buttons.values(), *controls], layout=_WRAP),
                self.screen,
            ]
        )
        self._renew()

    def refresh(self) -> None:
        """Compute with priorlab what the sliders say, and show it."""
        raise NotImplementedError(f"{type(self).__name__} must say how to refresh")

    def summary(self) -> str:
        """The numbers of the one-line repr."""
        raise NotImplementedError(f"{type(self).__name__} must say how to sum itself up")

    def set(self, **values: float) -> None:
        """Move several sliders at once: one new picture."""
        unknown = sorted(set(values) - set(self.sliders))
        if unknown:
            raise ValueError(f"a slider must be one of {', '.join(self.sliders)}, got {unknown[0]!r}")
        self._held = True
        try:
            for name, value in values.items():
                self.sliders[name].value = value
        finally:
            self._held = False
            self._renew()

    def reset(self) -> None:
        """All sliders back to where they stood at first."""
        self.set(**self._start)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.summary()})"

    def _repr_mimebundle_(self, **options: Any) -> dict[str, Any]:
        """The live widget, one line of text, and the first picture for readers without a kernel."""
        bundle = super()._repr_mimebundle_(**options) or {}
        bundle["text/plain"] = repr(self)
        if self.pictures and self.pictures[0].image:
            picture = self.pictures[0]
            is_text = picture.mime == "image/svg+xml"
            bundle[picture.mime] = picture.image.decode() if is_text else base64.b64encode(picture.image).decode()
        return bundle

    def _moved(self, change: Any) -> None:
        """A slider has a new value."""
        if not self._held:
            self._renew()

    def _renew(self) -> None:
        """Refresh, then send what has changed in one message."""
        self.refresh()
        self.screen.show(self.pictures, self.readout.value)

    def _button(self, name: str, values: Mapping[str, float]) -> ipywidgets.Button:
        """A button that sets some sliders."""
        settings = ", ".join(f"{key} = {value:g}" for key, value in values.items())
        button = ipywidgets.Button(description=name, tooltip=settings, layout=ipywidgets.Layout(width="auto"))
        button.on_click(lambda _: self.set(**values))
        return button


@dataclass
class Readout:
    """The numbers beside the pictures, HTML."""

    value: str = ""


def table(rows: Sequence[tuple[str, str]], caption: str = "") -> str:
    """A readout as HTML: a name and a number in each line."""
    head = f"<b>{caption}</b>" if caption else ""
    lines = "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows)
    return f"{head}<table>{lines}</table>"
