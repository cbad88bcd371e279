"""The animated picture of the README, from the screenshots that `make test-editors` left in out/screenshots: a finding,
its hover, its quick fix and the fixed file. Needs Pillow (`pip install --group images`)."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
FRAMES = (("1-squiggle", 2000), ("2-hover", 4000), ("4-quick-fix", 3000), ("5-after", 3000))
"""Screenshots with the milliseconds that each one stays."""
EDITOR = (348, 30, 1280, 440)
"""The part of a screenshot that the animation has, in pixels: left, top, right, bottom."""


def write(screenshots: Path, target: Path) -> None:
    """Join the screenshots into an animated WebP without loss."""
    first, *rest = [Image.open(screenshots / f"{name}.png").convert("RGB").crop(EDITOR) for name, _ in FRAMES]
    target.parent.mkdir(parents=True, exist_ok=True)
    durations = [milliseconds for _, milliseconds in FRAMES]
    first.save(target, save_all=True, append_images=rest, duration=durations, loop=0, lossless=True, quality=100)


if __name__ == "__main__":
    write(ROOT / "out/screenshots", ROOT / "docs/images/fix.webp")
