/* What the pages need of Apache ECharts 5.6.0; echarts.min.js is made of it:
     npm install echarts@5.6.0 esbuild@0.28.2
     NODE_PATH=node_modules npx esbuild echarts_subset.js --bundle --minify --target=es2019 --format=iife
       --global-name=echarts --legal-comments=inline --outfile=echarts.min.js */
export {init, use} from "echarts/core";
import {use} from "echarts/core";
import {CustomChart, LineChart, ParallelChart, ScatterChart} from "echarts/charts";
import {GridComponent, LegendPlainComponent, MarkAreaComponent, MarkLineComponent, ParallelComponent, TitleComponent,
  ToolboxComponent, TooltipComponent, VisualMapContinuousComponent} from "echarts/components";
import {LabelLayout} from "echarts/features";
import {SVGRenderer} from "echarts/renderers";
use([CustomChart, LineChart, ParallelChart, ScatterChart, GridComponent, LegendPlainComponent, MarkAreaComponent,
  MarkLineComponent, ParallelComponent, TitleComponent, ToolboxComponent, TooltipComponent, VisualMapContinuousComponent, LabelLayout,
  SVGRenderer]);
