"""What an edit changed in a text, and where the places of the rest are now."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Span, common_prefix, common_suffix


@dataclass(frozen=True, slots=True)
class Change:
    """The part of a text that is another one now: `before` in the old text, `after` in the new one. All in front of it
    and behind it is the same."""

    before: Span
    after: Span

    def moved(self, span: Span) -> Span:
        """Where a part of the old text is now; what of it was changed is all that was changed."""
        shift = self.after.end - self.before.end
        start = span.start + shift if span.start >= self.before.end else min(span.start, self.after.start)
        end = span.end if span.end <= self.before.start else max(span.end + shift, self.after.end)
        return Span(start, max(start, end))


def change(old: str, new: str) -> Change:
    """What has to be replaced to make one text of another."""
    start = common_prefix(old, new)
    behind = common_suffix(old[start:], new[start:])
    return Change(Span(start, len(old) - behind), Span(start, len(new) - behind))
