"""A Jupyter server that does not wait 40 ms before it sends a picture.

The kernel answers a slider with several messages. On an ordinary TCP connection the second is held back until the browser has
confirmed the first (Nagle's algorithm), and the browser takes up to 40 ms for that (delayed acknowledgement). Sending at once
saves them between key press and picture. `make lab` asks for it:

    jupyter lab --ServerApp.kernel_websocket_connection_class=priorlab.course.prompt_server.PromptConnection
"""

from __future__ import annotations

from typing import Any

from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection


class PromptConnection(ZMQChannelsWebsocketConnection):
    """Jupyter's own connection between kernel and browser, without the wait."""

    def connect(self) -> Any:
        """Send small messages at once, then connect as ever."""
        self.websocket_handler.set_nodelay(True)
        return super().connect()
