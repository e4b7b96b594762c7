"""The server of `make lab` sends small messages at once."""

from __future__ import annotations

from types import SimpleNamespace

from jupyter_server.services.kernels.connection.channels import ZMQChannelsWebsocketConnection

from priorlab.course.prompt_server import PromptConnection


def test_prompt_connection_switches_the_wait_off_before_it_connects(monkeypatch):
    done = []
    monkeypatch.setattr(ZMQChannelsWebsocketConnection, "connect", lambda self: done.append("connected"))
    connection = PromptConnection.__new__(PromptConnection)
    connection._trait_values["websocket_handler"] = SimpleNamespace(set_nodelay=lambda on: done.append(on))
    connection.connect()
    assert done == [True, "connected"]
