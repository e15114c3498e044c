// Words by npm's lindenmayer and by `sikku derive`, turn by turn: symbols a second of each.
// usage: node lindenmayer.mjs PROGRAM FOLDER_WITH_NODE_MODULES
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { performance } from 'node:perf_hooks';
import path from 'node:path';

const [program, folder] = process.argv.slice(2);
const LSystem = createRequire(path.join(folder, 'x.js'))('lindenmayer');
const System = LSystem.default ?? LSystem;

const signal = {
  '0<0>0': '0', '0<0>1': '1[+F1F1]', '0<1>0': '1', '0<1>1': '1', '1<0>0': '0', '1<0>1': '1F1', '1<1>0': '0', '1<1>1': '0',
  '+': '-', '-': '+',
};
const apex = ({ part }) => {
  const [s, w] = part.params;
  return [
    { symbol: '!', params: [w] }, { symbol: 'F', params: [s] },
    { symbol: '[' }, { symbol: '+', params: [35] }, { symbol: '/', params: [0] }, { symbol: 'A', params: [s * 0.75, w * Math.pow(0.5, 0.4)] }, { symbol: ']' },
    { symbol: '[' }, { symbol: '+', params: [-35] }, { symbol: '/', params: [0] }, { symbol: 'A', params: [s * 0.77, w * Math.pow(0.5, 0.4)] }, { symbol: ']' },
  ];
};

// Of each: the same system for both, and lengths that take each of them about a second.
const works = [
  {
    name: 'deterministic: the quadratic Koch island',
    theirs: { axiom: 'F-F-F-F', productions: { F: 'F-F+F+FF-F-F+F' } },
    ours: 'axiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\n',
    steps: [6, 9],
  },
  {
    name: 'stochastic: figure 3.16 of Prusinkiewicz & Hanan 1989',
    theirs: {
      axiom: 'F',
      productions: {
        F: { successors: [{ weight: 33, successor: 'F[+F]F[-F]F' }, { weight: 33, successor: 'F[+F]F' }, { weight: 34, successor: 'F[-F]F' }] },
      },
    },
    ours: 'axiom: F\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\n',
    steps: [9, 13],
  },
  {
    name: 'parametric: equation 11 of Prusinkiewicz et al. 1996',
    theirs: { axiom: [{ symbol: 'A', params: [100, 30] }], productions: { A: apex } },
    ours: 'axiom: A(100,30)\nA(s,w) : s >= 0 --> !(w)F(s)[+(35)/(0)A(s*0.75,w*0.5^0.4)][+(-35)/(0)A(s*0.77,w*0.5^0.4)]\n',
    steps: [14, 18],
  },
  {
    name: 'contexts: figure 3.11a of Prusinkiewicz & Hanan 1989 (whose branches lindenmayer reads otherwise)',
    theirs: { axiom: 'F1F1F1', productions: signal, branchSymbols: '[]', ignoredSymbols: '+-F' },
    ours: 'axiom: F1F1F1\nignore: +-F\n' +
      Object.entries(signal).map(([left, right]) => `${left.replace(/[<>]/g, ' $& ')} --> ${right}`).join('\n') + '\n',
    steps: [20, 50],
  },
];

/// Symbols made in a second, all steps counted for both; best of three.
function best(make) {
  let rate = 0;
  for (let i = 0; i < 3; ++i) {
    const begin = performance.now();
    const symbols = make();
    rate = Math.max(rate, symbols / (performance.now() - begin) * 1000);
  }
  return rate;
}

for (const work of works) {
  const theirs = best(() => {
    const system = new System(work.theirs);
    return system.iterate(work.steps[0]).length;
  });
  const measured = JSON.parse(execFileSync(program, ['measure', '-', '-n', String(work.steps[1]), '--json'], { input: work.ours }));
  const ours = best(() => {
    execFileSync('/bin/sh', ['-c', '"$0" --quiet derive - -n "$1" > /dev/null', program, String(work.steps[1])], { input: work.ours });
    return Number(measured.symbols);
  });
  console.log(`${work.name}\n  lindenmayer, n = ${work.steps[0]}: ${(theirs / 1e6).toFixed(2)} million symbols a second; ` +
    `sikku derive, n = ${work.steps[1]}, the whole program: ${(ours / 1e6).toFixed(1)}; ${(ours / theirs).toFixed(0)} times`);
}
