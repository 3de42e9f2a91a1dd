"""Pages for everyone: rules of accessibility by axe-core, the keyboard, the width of a phone.

`wrong(browser, path)` lists the rules that a page breaks and the pieces that stick out of a phone. `walked(page)` goes
through the page by Tab.
"""

import importlib.util
from pathlib import Path

SERIOUS = ("serious", "critical")
RUN = """axe.run(document, {resultTypes: ['violations']}).then(found => found.violations.map(rule =>
  [rule.impact, rule.id, rule.nodes.slice(0, 3).map(node => node.html.slice(0, 200))]))"""
# Controls that can be seen; of a group of radio buttons Tab comes to one
CONTROLS = """(() => {
  const all = 'a[href], button, input, select, textarea, summary, [tabindex="0"]';
  const groups = new Set(), first = each => each.type != 'radio' || !groups.has(each.form) && groups.add(each.form);
  return [...document.querySelectorAll(all)].filter(each => each.checkVisibility({visibilityProperty: true})
    && !each.disabled && !each.closest('[hidden]') && first(each));
})()"""
LOOK = "(s => [s.outlineStyle, s.outlineWidth, s.outlineColor, s.boxShadow, s.borderColor, s.backgroundColor].join())"


def faults(page):
    """(impact, rule, elements) of the serious faults that axe-core finds."""
    (folder,) = importlib.util.find_spec("axe_core_python").submodule_search_locations
    page.evaluate(Path(folder, "axe.min.js").read_text(encoding="utf-8") + "; 0")
    return [fault for fault in page.evaluate(RUN) if fault[0] in SERIOUS]


def tab(page):
    """Presses the Tab key."""
    for kind in ("rawKeyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9)


def walked(page):
    """Goes through all controls by Tab: those that were not reached, and those whose focus cannot be seen."""
    page.evaluate(
        f"window.controls = {CONTROLS}; window.reached = new Set(); window.unseen = [];"
        f"window.plain = controls.map(each => {LOOK}(getComputedStyle(each)));"
        "document.activeElement.blur(); scrollTo(0, 0)"
    )
    words = "(each => (each.id || each.name || each.textContent || each.className).trim().slice(0, 60))"
    for _ in range(page.evaluate("controls.length") + 5):
        tab(page)
        page.evaluate(
            "(() => { const at = document.activeElement, place = controls.findIndex(each => each == at ||"
            " each.type == 'radio' && each.form == at.form && each.name == at.name); if (place < 0) return;"
            " reached.add(controls[place]);"
            f" if ({LOOK}(getComputedStyle(at)) == plain[place]) unseen.push({words}(at)); }})()"
        )
    return page.evaluate(f"controls.filter(each => !reached.has(each)).map({words})"), page.evaluate("unseen")


def too_wide(page, width):
    """What makes the page wider than its window, if it is; a phone's own width grows with its content.

    The site's theme has the whole article, `.content`, scroll instead.
    """
    return page.evaluate(
        "[document.documentElement, ...document.querySelectorAll('.content')]"
        f".every(each => each.scrollWidth <= {width}) ? [] : [...document.querySelectorAll('body *')]"
        f".filter(each => each.getBoundingClientRect().right > {width} + 1).map(each => each.outerHTML.slice(0, 120))"
    )


DESK_AND_PHONE = ((1200, 800), (390, 800))


def wrong(browser, path, prepare="0", windows=DESK_AND_PHONE, schemes=("light",)):
    """All that is wrong with a file in windows of a desk and of a phone, after a script has been run in it."""
    found = []
    for scheme in schemes:
        page = browser.open(path, *windows[0], scheme)
        page.evaluate(prepare)
        for width, height in windows:
            page.resize(width, height)
            found += [f"{width} {scheme}: {fault}" for fault in faults(page)]
            found += [f"{width} {scheme}: too wide: {piece}" for piece in too_wide(page, width)]
        page.call("Page.close")
    return found
