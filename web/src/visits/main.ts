// SPDX-License-Identifier: GPL-3.0-or-later
// How one patient's expression changed between visits: the answer, faces, curves and figures, for a page of paper too.
import '../page/style.css';
import './visits.css';
import { at, element, startPage, unbroken } from '../page/dom';
import { upper } from '../page/format';
import { readPageData } from '../page/page_data';
import { Choice } from './choice';
import { Curves } from './curves';
import { explain } from './explain';
import { Faces } from './faces';
import type { Manifest } from './manifest';
import { fitOnPaper } from './printing';
import { MeasureTable } from './table';

function fillHead({ patient, expression, visits }: Manifest): void {
  const labels = visits.map(({ label }) => label);
  const span = labels.length > 1 ? `${labels[0]} to ${labels[labels.length - 1]}` : labels[0];
  at('title').textContent = patient ? `${patient}: ${expression}` : upper(expression);
  at('facts').textContent = `${visits.length} ${visits.length === 1 ? 'visit' : 'visits'}, ${span}`;
  // The name that a PDF gets.
  document.title = [patient, expression, span].filter((part) => part).join(', ');
}

function fillWords({ summary, notes, program, caveat }: Manifest): void {
  for (const sentence of summary) {
    const line = element('p');
    line.append(...unbroken(sentence));
    at('summary').append(line);
  }
  for (const note of notes) at('notes').append(element('li', note));
  at('notes').hidden = notes.length === 0;
  at('foot').append(element('p', caveat, 'caveat'), element('p', `Made by ${program}; needs no network.`));
}

function start(): void {
  const { manifest } = readPageData<Manifest>();
  const choice = new Choice(manifest.visits.length);
  fillHead(manifest);
  fillWords(manifest);
  at('seen').classList.toggle('beside', manifest.visits.length <= 2);
  const faces = new Faces(at('faces'), manifest, choice);
  const curves = new Curves(at('curves'), manifest, choice);
  const table = new MeasureTable(at('measures'), manifest, choice);
  explain(at('explained'), manifest);
  table.show();
  faces.show();
  curves.draw();
  fitOnPaper(() => curves.draw());
  const print = at<HTMLButtonElement>('print');
  print.hidden = false;
  print.addEventListener('click', () => window.print());
  document.documentElement.dataset.ready = 'true';
}

startPage(start);
