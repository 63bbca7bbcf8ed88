// The plug-in `fields`: the only file that knows VTK.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"
#include "output/field_codec.h"

namespace tenku {
namespace {

// Keeps VTK's error text, which it would print otherwise.
class ErrorKeeper : public vtkCommand {
 public:
  static ErrorKeeper* New() { return new ErrorKeeper; }
  void Execute(vtkObject*, unsigned long, void* data) override {
    if (text.empty() && data != nullptr) text = static_cast<const char*>(data);
  }
  std::string text;
};

void listen(vtkObject* object, ErrorKeeper* keeper) {
  object->AddObserver(vtkCommand::ErrorEvent, keeper);
  object->AddObserver(vtkCommand::WarningEvent, keeper);
}

vtkNew<vtkFloatArray> float_array(const FieldValues& field) {
  vtkNew<vtkFloatArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size()));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    array->SetValue(static_cast<vtkIdType>(i), static_cast<float>(field.values[i]));
  }
  return array;
}

vtkNew<vtkIntArray> int_array(const FieldCodes& field) {
  vtkNew<vtkIntArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(field.codes.size()));
  for (std::size_t i = 0; i < field.codes.size(); ++i) {
    array->SetValue(static_cast<vtkIdType>(i), field.codes[i]);
  }
  return array;
}

void add_text(vtkPolyData* data, const FieldText& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(text.name.c_str());
  for (const std::string& value : text.values) array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}

void set_points(vtkPolyData* data, const std::vector<Vec3>& points) {
  vtkNew<vtkPoints> stored;
  stored->SetDataTypeToFloat();
  stored->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    stored->SetPoint(static_cast<vtkIdType>(i), points[i].x, points[i].y, points[i].z);
  }
  data->SetPoints(stored);
}

void set_cells(vtkPolyData* data, const FieldMesh& mesh) {
  vtkNew<vtkCellArray> cells;
  if (mesh.polygon_count() == 0) {
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      cells->InsertNextCell({static_cast<vtkIdType>(i)});
    }
    return data->SetVerts(cells);
  }
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.polygon_ends) {
    cells->InsertNextCell(static_cast<int>(end - begin));
    for (; begin < end; ++begin) cells->InsertCellPoint(mesh.polygon_corners[begin]);
  }
  data->SetPolys(cells);
}

vtkNew<vtkPolyData> polydata_of(const FieldMesh& mesh, const std::string& software) {
  vtkNew<vtkPolyData> data;
  set_points(data, mesh.points);
  set_cells(data, mesh);
  for (const auto& field : mesh.point_values) data->GetPointData()->AddArray(float_array(field));
  for (const auto& field : mesh.cell_values) data->GetCellData()->AddArray(float_array(field));
  for (const auto& field : mesh.cell_codes) data->GetCellData()->AddArray(int_array(field));
  for (const auto& text : mesh.texts) add_text(data, text);
  add_text(data, {"software", {software}});
  return data;
}

FieldValues values_of(vtkDataArray* array) {
  FieldValues field{array->GetName(), {}};
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    field.values.push_back(array->GetTuple1(i));
  }
  return field;
}

void read_cells(vtkCellArray* cells, FieldMesh& mesh) {
  vtkNew<vtkIdList> corners;
  for (vtkIdType k = 0; k < cells->GetNumberOfCells(); ++k) {
    cells->GetCellAtId(k, corners);
    std::vector<std::uint32_t> polygon;
    for (const vtkIdType corner : *corners) polygon.push_back(static_cast<std::uint32_t>(corner));
    mesh.add_polygon(polygon);
  }
}

void read_arrays(vtkPolyData* data, FieldMesh& mesh) {
  vtkPointData* points = data->GetPointData();
  for (int k = 0; k < points->GetNumberOfArrays(); ++k) {
    mesh.point_values.push_back(values_of(points->GetArray(k)));
  }
  vtkCellData* cells = data->GetCellData();
  for (int k = 0; k < cells->GetNumberOfArrays(); ++k) {
    const FieldValues field = values_of(cells->GetArray(k));
    if (cells->GetArray(k)->GetDataType() != VTK_INT) {
      mesh.cell_values.push_back(field);
    } else {
      mesh.cell_codes.push_back({field.name, {field.values.begin(), field.values.end()}});
    }
  }
  vtkFieldData* texts = data->GetFieldData();
  for (int k = 0; k < texts->GetNumberOfArrays(); ++k) {
    const auto* array = vtkStringArray::SafeDownCast(texts->GetAbstractArray(k));
    if (array == nullptr) continue;
    FieldText text{texts->GetArrayName(k), {}};
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) {
      text.values.push_back(const_cast<vtkStringArray*>(array)->GetValue(i));
    }
    mesh.texts.push_back(text);
  }
}

class VtkCodec : public FieldCodec {
 public:
  std::string vtp_bytes(const FieldMesh& mesh, const std::string& software) const override {
    vtkNew<ErrorKeeper> errors;
    vtkNew<vtkXMLPolyDataWriter> writer;
    listen(writer, errors);
    writer->WriteToOutputStringOn();
    writer->SetInputData(polydata_of(mesh, software));
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToZLib();
    if (writer->Write() != 1 || writer->GetErrorCode() != 0 || !errors->text.empty()) {
      throw ResourceError("cannot make a VTK file: " + errors->text);
    }
    return writer->GetOutputString();
  }

  FieldMesh read_vtp(const std::filesystem::path& path) const override {
    vtkNew<ErrorKeeper> errors;
    vtkNew<vtkXMLPolyDataReader> reader;
    listen(reader, errors);
    if (reader->CanReadFile(path.c_str()) == 0) {
      throw InputError("cannot read " + path.string() + ": it is no VTK PolyData file");
    }
    reader->SetFileName(path.c_str());
    reader->Update();
    if (reader->GetErrorCode() != 0 || !errors->text.empty()) {
      throw InputError("cannot read " + path.string() + ": " + errors->text);
    }
    vtkPolyData* data = reader->GetOutput();
    FieldMesh mesh;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
      const double* p = data->GetPoint(i);
      mesh.points.push_back({p[0], p[1], p[2]});
    }
    read_cells(data->GetPolys(), mesh);
    read_arrays(data, mesh);
    return mesh;
  }
};

}  // namespace
}  // namespace tenku

const tenku::Plugin* tenku_plugin() {
  static const tenku::VtkCodec codec;
  return &codec;
}
