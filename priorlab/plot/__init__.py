"""Pictures: data and an ax in, the ax out; one file per chapter. Matplotlib loads with the first picture.

    ax = pl.plot.map(posterior, poses=plan.survey)

Without an `ax` a new figure is made. Maps have y up, in pixels or metres as the axes say; pictures of chapter 3 lie as the image.
Colours are those of Okabe and Ito and never the only sign.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
