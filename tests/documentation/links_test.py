"""Checks docs/: each relative link and picture resolves, each anchor is a heading, each page is in mkdocs.yml once, each
picture is used, and the rows of each table have as many cells as its head.

usage: links_test.py ROOT [unittest arguments]
"""

import pathlib
import re
import sys
import unittest

LINK = re.compile(r"\]\(([^)\s]+)\)")
NAV_PAGE = re.compile(r"^\s*- (?:.*: )?(\S+\.md)$", re.MULTILINE)
IMAGES = {".png", ".svg"}


def prose(text):
    """Without code, whose brackets are no links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "code", text)


def slugs(heading):
    """The anchors that GitHub and Python-Markdown make of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    text = re.sub(r"[^\w\s-]", "", text)
    ascii_text = text.encode("ascii", "ignore").decode().strip()
    return re.sub(r"\s", "-", text), re.sub(r"[-\s]+", "-", ascii_text)


def anchors_of(page):
    """Those that work on GitHub and on the site."""
    text = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    return {github for github, site in map(slugs, re.findall(r"^#+ (.*)$", text, re.MULTILINE)) if github == site}


def links_of(page):
    for link in LINK.findall(prose(page.read_text())):
        if not re.match(r"[a-z]+:", link):
            path, _, anchor = link.partition("#")
            yield link, (page.parent / path if path else page).resolve(), anchor


def cells_of(row):
    """A bar divides cells even inside code; \\| does not."""
    return len(re.findall(r"(?<!\\)\|", row.strip())) - 1


def ragged_rows(page):
    """Line numbers of the table rows whose number of cells differs from the row above."""
    previous = None
    in_code = False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        in_code ^= line.startswith("```")
        row = line.strip() if not in_code and line.strip().startswith("|") else None
        if row and previous and cells_of(row) != cells_of(previous):
            yield number
        previous = row


class Documentation(unittest.TestCase):
    def setUp(self):
        self.docs = root / "docs"
        self.pages = sorted(self.docs.rglob("*.md"))

    def test_every_link_resolves(self):
        self.assertGreater(len(self.pages), 40)
        for page in [*self.pages, *root.glob("*.md"), *root.glob("presets/*.md")]:
            for link, target, anchor in links_of(page):
                with self.subTest(page=str(page.relative_to(root)), link=link):
                    self.assertTrue(target.exists())
                    if anchor and target.suffix == ".md":
                        self.assertIn(anchor, anchors_of(target))

    def test_pages_link_only_within_the_site(self):
        for page in self.pages:
            for link, target, _ in links_of(page):
                with self.subTest(page=str(page.relative_to(root)), link=link):
                    self.assertTrue(target.is_relative_to(self.docs.resolve()))

    def test_every_page_is_in_the_navigation_once(self):
        in_navigation = NAV_PAGE.findall((root / "mkdocs.yml").read_text())
        self.assertEqual(sorted(in_navigation), [str(page.relative_to(self.docs)) for page in self.pages])

    def test_every_page_is_in_the_index(self):
        index = self.docs / "README.md"
        linked = {target for _, target, _ in links_of(index)} | {index.resolve()}
        # Of the folder of AO methods the index links the pages that list the others.
        for page in [*self.docs.glob("*.md"), *self.docs.glob("*/*.md")]:
            if page.parent.name != "ambient-occlusion":
                with self.subTest(page=str(page.relative_to(root))):
                    self.assertIn(page.resolve(), linked)

    def test_the_rows_of_a_table_have_equally_many_cells(self):
        for page in [*self.pages, *root.glob("*.md"), *root.glob("presets/*.md")]:
            with self.subTest(page=str(page.relative_to(root))):
                self.assertEqual(list(ragged_rows(page)), [])

    def test_every_picture_is_used(self):
        used = {target for page in [*self.pages, *root.glob("*.md")] for _, target, _ in links_of(page)}
        pictures = [each for each in (self.docs / "images").iterdir() if each.suffix in IMAGES]
        # A figure in one format may lie beside the other.
        stems = {each.with_suffix("") for each in used}
        for picture in pictures:
            with self.subTest(picture=picture.name):
                self.assertIn(picture.resolve().with_suffix(""), stems)


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
