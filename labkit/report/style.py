"""Style of the HTML pages: colours for light and dark, cards, tables, phones."""

STYLE = """
:root { color-scheme: light dark; --paper: #f6f7f9; --card: #fff; --ink: #1b1f24;
  --muted: #5c6670; --grid: #e3e7eb; --line: #3467b4; --pass: #1a7f37;
  --fail: #c4232e; --limit: #8a5a00; }
@media (prefers-color-scheme: dark) { :root { --paper: #0f1317; --card: #181d23;
  --ink: #e6eaee; --muted: #98a3ae; --grid: #2a323a; --line: #78aaf5;
  --pass: #4cc26a; --fail: #ff7b72; --limit: #dfae55; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1240px; padding: 32px 20px 48px; color: var(--ink);
  background: var(--paper); font: 15px/1.45 system-ui, -apple-system, "Segoe UI",
  Roboto, "Noto Sans", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums;
  overflow-wrap: anywhere; }
h1 { margin: 0; font-size: 28px; letter-spacing: -.01em; }
h2 { margin: 36px 0 12px; font-size: 19px; }
p { margin: 4px 0; } .jumps { margin-top: 14px; } .muted { color: var(--muted); }
.tiles { display: grid; gap: 12px; margin-top: 20px;
  grid-template-columns: repeat(auto-fit, minmax(130px, 1fr)); }
.tile, .card { background: var(--card); border: 1px solid var(--grid);
  border-radius: 12px; padding: 14px 16px; }
.tile b { display: block; font-size: 26px; line-height: 1.2; }
.cards { display: grid; gap: 16px; align-items: start;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 340px), 1fr)); }
.top { display: flex; gap: 10px; justify-content: space-between; align-items: start; }
.top h3 { margin: 0; font-size: 16px; }
.badge { flex: none; border: 1px solid; border-radius: 99px; padding: 1px 10px;
  font-size: 13px; font-weight: 600; white-space: nowrap; }
.pass { color: var(--pass); } .fail { color: var(--fail); }
.open, .none { color: var(--muted); }
dl { display: grid; grid-template-columns: repeat(4, auto); gap: 0 12px;
  margin: 12px 0 8px; justify-content: space-between; }
dt { grid-row: 1; color: var(--muted); font-size: 12px; }
dd { grid-row: 2; margin: 0; font-weight: 600; white-space: nowrap; }
svg { display: block; width: 100%; height: auto; font-size: 11px; }
details { margin-top: 6px; } summary { cursor: pointer; color: var(--muted);
  font-size: 13px; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; font-size: 13px;
  margin-top: 8px; min-width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 4px 12px 4px 0;
  border-top: 1px solid var(--grid); } tr:first-child th { border-top: 0; }
th, td { white-space: nowrap; } th { color: var(--muted); font-weight: 500; }
td.note { white-space: normal; min-width: 150px; }
code { font: 12px/1.4 ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; }
@media print { body { max-width: none; } .card { break-inside: avoid; } }
"""
