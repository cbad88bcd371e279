"""The topics and services that the sources of a workspace name as they make them, whatever launch starts the nodes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from itertools import chain

from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.graph.model import Connection
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.recognize import launch_files_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.dangling import GENERIC_PACKAGES
from preflight_analysis.model.entry import Entry
from preflight_analysis.model.name_index import named_in, own_folders, sources_in
from preflight_analysis.model.nearest import likeness

_ENOUGH = 2
"""Files that have to agree on a name where none offers it."""


def meant_in_sources(context: Context, connection: Connection) -> tuple[str, int] | None:
    """The name of which that of a consumer is a slip, by what the sources of the workspace make with that type, and how
    many of them do. None where one of them offers the consumer's own."""
    type_ = connection.endpoint.type
    if type_ is None or of_specific_type(connection) is None:
        return None
    own, kind = connection.endpoint.name.strip("~/"), type_.rpartition("/")[2]
    known = _in_workspace(context.disk.db, context.environment)
    # What a node takes in and what it gives out have like names on purpose.
    source = connection.endpoint.source_file
    beside = {each.text for each in named_in(context.disk.db, source, "topic")} if source is not None else set()
    files: Counter[str] = Counter()
    for each, count in known.items():
        alike, offers = likeness(f"/{own}", f"/{each.text}"), each.role == "offer"
        if alike is None or alike[0] != "typo":
            if offers and names.leaf(each.text) == names.leaf(own):
                return None
            continue
        # Without an offer it is a word of several against one.
        enough = each.text not in beside and (
            offers or (count >= _ENOUGH and known.get(Entry("topic", own, "use", type=kind), 0) <= 1)
        )
        if each.type == kind and enough:
            files[each.text] += count
    return next(iter(files.items())) if len(files) == 1 else None


def of_specific_type(connection: Connection) -> Connection | None:
    """The end itself, if its source alone names it, and its type says what is carried."""
    type_ = connection.endpoint.type
    is_specific = type_ not in (None, "*") and not (type_ or "").startswith(GENERIC_PACKAGES)
    return connection if connection.remap is None and is_specific else None


@query
def writes_name(db: Database, share: str, name: str) -> bool:
    """Whether a source of the package, beside its launch files, has the name in quotes, without regard to `~` and
    slashes at its ends."""
    paths = sources_in(db, share) or ()
    launches = set(launch_files_of(db, paths))
    wanted = name.strip("~/")
    in_files = (named_in(db, path, "name") for path in paths if path not in launches)
    return any(each.text.strip("~/") == wanted for names_of_file in in_files for each in names_of_file)


@query
def _in_workspace(db: Database, environment: Environment) -> Mapping[Entry, int]:
    """In how many sources each topic and service is."""
    counts: Counter[Entry] = Counter()
    for share in own_folders(db, environment):
        counts.update(chain.from_iterable(named_in(db, path, "topic") for path in sources_in(db, share) or ()))
    return dict(counts)
