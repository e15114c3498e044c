// A word by npm's lindenmayer, printed to standard output as `sikku derive` prints it.
// usage: node lindenmayer_peer.mjs FOLDER_WITH_NODE_MODULES WORK N
import { createRequire } from 'node:module';
import path from 'node:path';

const [folder, work, n] = process.argv.slice(2);
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

const systems = {
  derive: { axiom: 'F-F-F-F', productions: { F: 'F-F+F+FF-F-F+F' } },
  'by chance': {
    axiom: 'F',
    productions: {
      F: { successors: [{ weight: 33, successor: 'F[+F]F[-F]F' }, { weight: 33, successor: 'F[+F]F' }, { weight: 34, successor: 'F[-F]F' }] },
    },
  },
  parameters: { axiom: [{ symbol: 'A', params: [100, 30] }], productions: { A: apex } },
  // lindenmayer reads the branches of figure 3.11a otherwise; the words grow alike.
  contexts: { axiom: 'F1F1F1', productions: signal, branchSymbols: '[]', ignoredSymbols: '+-F' },
};

const system = new System(systems[work]);
system.iterate(Number(n));
process.stdout.write(`${system.getString()}\n`);
