"""What all kinds of plugins are: a frozen model of parameters, with a summary and a source."""

from __future__ import annotations

from abc import ABC
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict

from gipkg.errors import BrokenPluginError


class Plugin(BaseModel, ABC):
    """Base of all kinds: parameters as fields, metadata as class variables."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    summary: ClassVar[str]
    """One line for listings and tables."""
    citation: ClassVar[str]
    """The publication the method comes from, as author, title, venue and year."""

    @classmethod
    def __pydantic_init_subclass__(cls, **_: Any) -> None:
        for name, info in cls.model_fields.items():
            if info.is_required():
                raise BrokenPluginError(f"{cls.__name__}.{name} needs a default value")
            if not info.description:
                raise BrokenPluginError(
                    f"{cls.__name__}.{name} needs a help text: Field(..., description='…')"
                )
