//! What a Markdown page refers to, and what in it can be referred to.

use std::collections::BTreeSet;

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// A link, picture or inclusion of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Reference {
    /// Where it stands, from 1.
    pub(crate) line: usize,
    /// As it is written.
    pub(crate) target: String,
}

/// A page, read.
#[derive(Debug, Default)]
pub(crate) struct Page {
    /// All that it refers to, in order.
    pub(crate) references: Vec<Reference>,
    /// The ids of its headings.
    pub(crate) anchors: BTreeSet<String>,
}

impl Page {
    /// Reads a page: links and pictures of Markdown and of HTML, mdBook's `{{#include …}}`, and headings.
    pub(crate) fn read(text: &str) -> Self {
        let mut page = Self::default();
        let mut in_comment = false;
        let mut heading: Option<(Option<String>, String)> = None;
        let options =
            Options::ENABLE_TABLES | Options::ENABLE_FOOTNOTES | Options::ENABLE_STRIKETHROUGH | Options::ENABLE_HEADING_ATTRIBUTES;
        for (event, range) in Parser::new_ext(text, options).into_offset_iter() {
            let line = || 1 + text[..range.start].matches('\n').count();
            match event {
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => page.refer(line(), &dest_url),
                Event::Html(html) | Event::InlineHtml(html) => {
                    html_targets(&without_comments(&html, &mut in_comment)).for_each(|target| page.refer(line(), target));
                }
                Event::Start(Tag::Heading { id, .. }) => heading = Some((id.map(|id| id.to_string()), String::new())),
                Event::End(TagEnd::Heading(_)) => {
                    if let Some((id, content)) = heading.take() {
                        page.add_anchor(&id.unwrap_or_else(|| slug(&content)));
                    }
                }
                Event::Text(words) | Event::Code(words) => {
                    if let Some((_, content)) = &mut heading {
                        content.push_str(&words);
                    }
                }
                _ => {}
            }
        }
        // mdBook puts inclusions in before it reads Markdown, so they count within code blocks too.
        for (number, line) in text.lines().enumerate() {
            inclusions(line).for_each(|target| page.refer(number + 1, target));
        }
        page
    }

    fn refer(&mut self, line: usize, target: &str) {
        self.references.push(Reference { line, target: target.to_owned() });
    }

    /// As mdBook makes ids one of a kind: `id`, `id-1`, `id-2`.
    fn add_anchor(&mut self, id: &str) {
        let free = (1..).map(|number| format!("{id}-{number}"));
        let free = std::iter::once(id.to_owned()).chain(free).find(|id| !self.anchors.contains(id));
        self.anchors.extend(free);
    }
}

/// A heading's id, as mdBook makes it.
fn slug(heading: &str) -> String {
    let letter = |letter: char| match letter {
        _ if letter.is_alphanumeric() || letter == '_' || letter == '-' => Some(letter),
        _ if letter.is_whitespace() => Some('-'),
        _ => None,
    };
    heading.trim().to_lowercase().chars().filter_map(letter).collect()
}

/// What of a piece of HTML lies outside comments. Pieces are lines, so `in_comment` carries an open one on.
fn without_comments(html: &str, in_comment: &mut bool) -> String {
    let mut outside = String::new();
    let mut rest = html;
    while !rest.is_empty() {
        let mark = if *in_comment { "-->" } else { "<!--" };
        let (before, after) = rest.split_once(mark).map_or((rest, None), |(before, after)| (before, Some(after)));
        if !*in_comment {
            outside.push_str(before);
        }
        *in_comment ^= after.is_some();
        rest = after.unwrap_or("");
    }
    outside
}

/// The values of `src` and `href` in a piece of HTML.
fn html_targets(html: &str) -> impl Iterator<Item = &str> {
    ["src=\"", "href=\""].into_iter().flat_map(move |name| html.split(name).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0)))
}

/// The files of `{{#include file:lines}}`, `{{#rustdoc_include file}}` and `{{#playground file}}` in a line, unless escaped.
fn inclusions(line: &str) -> impl Iterator<Item = &str> {
    line.match_indices("{{#").filter_map(move |(start, _)| {
        let inside = line[start + 3..].split_once("}}")?.0;
        let (verb, file) = inside.split_once(' ')?;
        let includes = matches!(verb, "include" | "rustdoc_include" | "playground") && !line[..start].ends_with('\\');
        includes.then(|| file.split([':', ' ']).next().unwrap_or(file))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn targets(text: &str) -> Vec<(usize, String)> {
        Page::read(text).references.into_iter().map(|reference| (reference.line, reference.target)).collect()
    }

    #[test]
    fn links_pictures_html_and_inclusions_are_seen() {
        let text = "# One\n[a](a.md#x) and ![b](b.png)\n\n<img src=\"c.png\" width=\"9\">\n\nsee [d]\n\n\
            | t |\n|---|\n| [e](e.md) |\n\n```rust\n{{#include ../f.rs:3:9}}\n```\n\n[d]: d.md\n";
        let expected = [(2, "a.md#x"), (2, "b.png"), (4, "c.png"), (6, "d.md"), (10, "e.md"), (13, "../f.rs")];
        assert_eq!(targets(text), expected.map(|(line, target)| (line, target.to_owned())));
    }

    #[test]
    fn code_and_comments_are_not_links() {
        let comment = "<!-- picture:\n<img src=\"a.png\">\n--> <img src=\"b.png\">\n";
        assert_eq!(targets(comment), [(3, "b.png".to_owned())]);
        assert_eq!(targets("`[a](b.md)`\n\n<!-- picture: <img src=\"a.png\"> -->\n\n```md\n[a](b.md)\n```\n\\{{#include x.rs}}"), []);
    }

    #[test]
    fn headings_can_be_linked_to() {
        let page = Page::read("# Half-edges, in *flat* arrays\n## `u32` handles\n## Twice\n## Twice\n## Named {#own}\n");
        let expected = ["half-edges-in-flat-arrays", "u32-handles", "twice", "twice-1", "own"];
        assert_eq!(page.anchors, expected.map(str::to_owned).into());
    }
}
