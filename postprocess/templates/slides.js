const slides = [...document.querySelectorAll("section")];
function here() { return slides.findIndex(s => s.getBoundingClientRect().bottom > innerHeight / 2); }
function go(k) { slides[Math.max(0, Math.min(slides.length - 1, k))].scrollIntoView(); }
addEventListener("keydown", event => {
  if (event.target.tagName == "BUTTON" && event.key == " ") return;
  const box = event.target.closest?.(".scroll, pre");
  if (box && box.scrollWidth > box.clientWidth && /Left|Right/.test(event.key)) return;
  const by = { ArrowRight: 1, ArrowDown: 1, PageDown: 1, " ": 1, ArrowLeft: -1, ArrowUp: -1, PageUp: -1 }[event.key];
  if (by) { event.preventDefault(); go(here() + by); }
  if (event.key == "Home") go(0);
  if (event.key == "End") go(slides.length - 1);
});
for (const film of document.querySelectorAll(".film")) {
  const frames = [...film.querySelectorAll(".frame")];
  let now = 0, timer = 0;
  function show(k) { now = (k + frames.length) % frames.length; frames.forEach((f, i) => f.classList.toggle("now", i == now)); }
  const does = { back: () => show(now - 1), on: () => show(now + 1),
    play: () => { if (timer) { clearInterval(timer); timer = 0; } else timer = setInterval(() => show(now + 1), 1200); } };
  for (const button of film.querySelectorAll("button")) button.onclick = does[button.dataset.do];
  show(0);
}
