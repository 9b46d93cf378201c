"""How the page looks: its colours, and the mark and word for each status."""

from robo47.report.page import STYLE as REPORT_STYLE

STATUS = {  # role of the colour, mark in the table, word in the legend
    "passed": ("pass", "✓", "passed"),
    "close": ("limit", "≈", "close"),
    "wrong": ("fail", "✗", "wrong"),
    "todo": ("none", "·", "to do"),
    "ungraded": ("dark", "?", "not graded"),
}
STYLE = (
    REPORT_STYLE
    + """
:root { --none: #b9c2cb; --dark: #4a525b; }
@media (prefers-color-scheme: dark) { :root { --none: #4a5560; --dark: #b9c2cb; } }
body { max-width: 1080px; } .none { color: var(--muted); }
.limit { color: var(--limit); } .dark { color: var(--dark); }
.two { display: grid; gap: 16px; align-items: start;
  grid-template-columns: repeat(auto-fit, minmax(min(100%, 420px), 1fr)); }
.card h3 { margin: 0 0 4px; font-size: 16px; } .card > .muted { margin-bottom: 12px; }
svg.bars { overflow: visible; font-size: 13px; margin-top: 12px; }
.legend span { margin-right: 14px; white-space: nowrap; font-size: 13px; }
.legend i { display: inline-block; width: 10px; height: 10px; margin-right: 5px;
  border-radius: 2px; }
ul { list-style: none; margin: 0; padding: 0; }
li { padding: 10px 0; border-top: 1px solid var(--grid); } li:first-child { border: 0; }
li .head { display: flex; flex-wrap: wrap; gap: 4px 12px; align-items: baseline; }
li .head > .muted { margin-left: auto; font-size: 13px; } li p { margin-top: 3px; }
.says { white-space: pre-line; } details { margin: 0; padding: 7px 0; }
details + details { border-top: 1px solid var(--grid); }
summary { color: var(--ink); font-size: 14px; } details p { margin: 6px 0 4px 16px; }
td.mark, th.mark { text-align: center; padding-right: 8px; }
@media (max-width: 560px) { li .head > .muted { margin-left: 0; flex-basis: 100%; }
  td:first-child { max-width: 130px; overflow: hidden; text-overflow: ellipsis; } }
h2 small { color: var(--muted); font-weight: 400; }
"""
)
