// ---- Scenes to turn around, within another page

/// A button with data-view="N" opens the N-th scene of the element `views` below itself: a frame that holds the page of the element `viewer`.
/// One at a time, and made when it is asked for: thirty scenes would be thirty canvases. The button or Escape closes it.
let opened = null;
function closeScene() {
  if (!opened) return;
  const {knob, frame} = opened;
  opened = null;
  frame.remove();
  knob.setAttribute('aria-expanded', 'false');
  knob.textContent = knob.dataset.words;
  knob.parentElement.classList.remove('turned');
  knob.focus();
}
function openScene(knob) {
  const held = id => JSON.parse(document.getElementById(id).textContent), frame = document.createElement('iframe');
  const scene = JSON.stringify(held('views')[knob.dataset.view]).replaceAll('<', '\\u003c');
  frame.className = 'scene';
  frame.title = 'The scene, to turn around; Escape closes it';
  frame.srcdoc = held('viewer').replace('\x3c!--data-->', () => scene);
  frame.addEventListener('load', () => {
    frame.contentDocument.addEventListener('keydown', escapes);
    frame.contentDocument.getElementById('view').focus();
  });
  opened = {knob, frame};
  knob.dataset.words = knob.textContent;
  knob.textContent = 'close';
  knob.setAttribute('aria-expanded', 'true');
  knob.parentElement.classList.add('turned');
  knob.after(frame);
  frame.scrollIntoView({block: 'nearest'});
}
function escapes(e) { if (e.key === 'Escape') closeScene(); }
document.addEventListener('keydown', escapes);
document.addEventListener('click', e => {
  const knob = e.target.closest('button[data-view]'), again = knob && opened && opened.knob === knob;
  if (!knob) return;
  closeScene();
  if (!again) openScene(knob);
});
